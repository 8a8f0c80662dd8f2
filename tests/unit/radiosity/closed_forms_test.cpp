// Closed forms of form factors against tabulated values, against each other, and against contour integration.
#include "radiosity/closed_forms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace etendue::radiosity {
namespace {

TEST(ClosedForms, ParallelRectangles) {
  EXPECT_NEAR(parallel_rectangles(1, 1, 1), 0.1998248957, 1e-10);
  EXPECT_NEAR(parallel_rectangles(1, 1, 0.1), 0.8269945224, 1e-10);
  EXPECT_NEAR(parallel_rectangles(1, 1, 0.5), 0.4152532836, 1e-10);
  EXPECT_NEAR(parallel_rectangles(1, 1, 2), 0.0685895888, 1e-10);
  EXPECT_NEAR(parallel_rectangles(2, 1, 1), 0.2858753849, 1e-10);
  EXPECT_NEAR(parallel_rectangles(1, 2, 3), 0.0603313854, 1e-10);
}

TEST(ClosedForms, PerpendicularRectangles) {
  EXPECT_NEAR(perpendicular_rectangles(1, 1), 0.2000437761, 1e-10);
  EXPECT_NEAR(perpendicular_rectangles(2, 1), 0.1164263014, 1e-10);
  EXPECT_NEAR(perpendicular_rectangles(1, 2), 0.2328526028, 1e-10);
  EXPECT_NEAR(perpendicular_rectangles(0.25, 1.5), 0.37677815, 1e-8);
  EXPECT_NEAR(perpendicular_rectangles(3, 0.25), 0.0318991170, 1e-10);
}

// Closed boxes: the factors from one side to the five others add up to 1.
TEST(ClosedForms, ClosureOfBoxes) {
  EXPECT_NEAR(parallel_rectangles(1, 1, 1) + 4 * perpendicular_rectangles(1, 1), 1, 1e-14);
  EXPECT_NEAR(
      parallel_rectangles(1, 2, 3) + 2 * perpendicular_rectangles(0.5, 1.5) + 2 * perpendicular_rectangles(2, 3), 1,
      1e-14);
  EXPECT_NEAR(2 * perpendicular_rectangles(2, 1), perpendicular_rectangles(1, 2), 1e-15);  // reciprocity
}

TEST(ClosedForms, CoaxialDisks) {
  EXPECT_NEAR(coaxial_disks(1, 1, 1), (3 - std::sqrt(5.0)) / 2, 1e-15);
  EXPECT_NEAR(coaxial_disks(1, 2, 1.5), 4 * coaxial_disks(2, 1, 1.5), 1e-14);  // reciprocity
}

TEST(ClosedForms, PointToDisk) {
  for (const double r : {0.01, 0.5, 1.0, 3.0})
    for (const double h : {0.1, 1.0, 5.0}) EXPECT_NEAR(point_to_disk(r, h), r * r / (r * r + h * h), 2e-15);
  // A polygon with many corners, seen from below its centre and from beside it.
  constexpr int kCorners = 20'000;
  for (const double offset : {0.0, 0.4, 1.0, 2.5}) {
    Polygon disk;
    for (int k = kCorners; k > 0; --k) {
      const double phi = 2 * std::numbers::pi * k / kCorners;
      disk.emplace_back(offset + std::cos(phi), std::sin(phi), 0.7);
    }
    EXPECT_NEAR(point_to_disk(1, 0.7, offset), point_to_polygon(DVec3(0), DVec3(0, 0, 1), disk), 1e-7) << offset;
  }
  // The mean over a disk is the factor between two disks.
  double mean = 0;
  constexpr int kRings = 2000;
  for (int k = 0; k < kRings; ++k) mean += point_to_disk(2, 1.5, std::sqrt((k + 0.5) / kRings)) / kRings;
  EXPECT_NEAR(mean, coaxial_disks(1, 2, 1.5), 1e-7);
}

// Additivity, and a rectangle beside the foot of the point as the difference of rectangles with a corner there.
TEST(ClosedForms, AlgebraOfFormFactors) {
  const double w = 0.8;
  const Polygon offset{{0.5, 0.25, w}, {0.5, 1.5, w}, {2, 1.5, w}, {2, 0.25, w}};
  const double by_corners = point_to_rectangle(2, 1.5, w) - point_to_rectangle(0.5, 1.5, w) -
                            point_to_rectangle(2, 0.25, w) + point_to_rectangle(0.5, 0.25, w);
  EXPECT_NEAR(point_to_polygon(DVec3(0), DVec3(0, 0, 1), offset), by_corners, 1e-14);
  // A floor of depth 2 exchanges light with a wall as its two halves together.
  EXPECT_NEAR(
      perpendicular_rectangles(2, 1),
      0.5 * (perpendicular_rectangles(1, 1) + contour_exchange({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}},
                                                               {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, 32)),
      1e-9);
}

constexpr double kPointToRectangle[][4] = {{1, 1, 1, 0.1385316060},      {2, 1, 1, 0.1673750099},
                                           {1, 2, 1, 0.1673750099},      {3, 0.5, 2, 0.0556410975},
                                           {0.25, 0.5, 1, 0.0330913069}, {10, 10, 1, 0.2479714083}};

TEST(ClosedForms, PointToRectangle) {
  for (const auto& [u, v, w, factor] : kPointToRectangle) EXPECT_NEAR(point_to_rectangle(u, v, w), factor, 1e-10);
}

TEST(ClosedForms, PointToPolygonEqualsPointToRectangle) {
  for (const auto& [u, v, w, factor] : kPointToRectangle) {
    const Polygon above{{0, 0, w}, {0, v, w}, {u, v, w}, {u, 0, w}};  // faces down
    EXPECT_NEAR(point_to_polygon(DVec3(0), DVec3(0, 0, 1), above), factor, 1e-10);
    Polygon turned = above;
    std::ranges::reverse(turned);
    EXPECT_EQ(point_to_polygon(DVec3(0), DVec3(0, 0, 1), turned), 0) << "a polygon that faces away";
  }
}

// The part of a wall below the horizon does not count.
TEST(ClosedForms, PointToPolygonClipsAtTheHorizon) {
  const Polygon wall{{1, -1, -2}, {1, -1, 3}, {1, 1, 3}, {1, 1, -2}},
      upper{{1, -1, 0}, {1, -1, 3}, {1, 1, 3}, {1, 1, 0}};
  const double whole = point_to_polygon(DVec3(0), DVec3(0, 0, 1), wall);
  EXPECT_GT(whole, 0.1);
  EXPECT_NEAR(whole, point_to_polygon(DVec3(0), DVec3(0, 0, 1), upper), 1e-15);
}

Polygon floor_square() { return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}; }

TEST(ClosedForms, ContourIntegration) {
  const Polygon ceiling{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const Polygon wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};  // faces +x, shares an edge with the floor
  EXPECT_NEAR(contour_exchange(floor_square(), ceiling), 0.1998248957, 1e-9);
  EXPECT_NEAR(contour_exchange(floor_square(), wall), 0.2000437761, 1e-9);
}

// Random pairs of polygons in front of each other: the exchange is reciprocal, and equals the mean over points of the
// closed form.
TEST(ClosedForms, ContourIntegrationOfRandomPolygons) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int n = 0; n < 20; ++n) {
    const double h = 0.2 + uniform(random), tilt = 0.3 * uniform(random);
    const Polygon a = floor_square(),
                  b{{uniform(random), 0, h}, {0.2, 1, h + tilt}, {1, 0.4 + uniform(random), h + tilt}};
    const double exchange = contour_exchange(a, b, 24);
    EXPECT_NEAR(exchange, contour_exchange(b, a, 24), 1e-9);
    constexpr int kPoints = 64;
    double mean = 0;
    for (int i = 0; i < kPoints; ++i)
      for (int j = 0; j < kPoints; ++j)
        mean += point_to_polygon({(i + 0.5) / kPoints, (j + 0.5) / kPoints, 0}, {0, 0, 1}, b);
    EXPECT_NEAR(exchange, mean / (kPoints * kPoints), 2e-4);
  }
}

}  // namespace
}  // namespace etendue::radiosity
