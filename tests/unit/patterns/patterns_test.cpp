// Quality of point sets: exact discrepancies, nets, distances and spectra of sets with known values, and a search over
// boxes as a second computation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "equations/random_numbers.h"
#include "patterns/cube_discrepancy.h"
#include "patterns/discrepancy.h"
#include "patterns/distances.h"
#include "patterns/known_sets.h"
#include "patterns/net_quality.h"
#include "patterns/pattern_report.h"
#include "patterns/periodogram.h"
#include "patterns/sampler_points.h"
#include "sampling/halton.h"
#include "sampling/point_sets/niederreiter.h"
#include "sampling/sobol.h"

namespace etendue::patterns {
namespace {

PointSet random_set(uint32_t n, uint64_t seed) {
  equations::RandomNumbers random(seed);
  PointSet set;
  for (uint32_t i = 0; i < n; ++i) {
    const double x = random.uniform();
    set.push_back({x, random.uniform()});
  }
  return set;
}

TEST(Discrepancy, HaltonHasItsExactValues) {
  EXPECT_NEAR(star_discrepancy(halton_points(4)), 1.0 / 2, 1e-12);
  EXPECT_NEAR(star_discrepancy(halton_points(8)), 23.0 / 72, 1e-12);
  EXPECT_NEAR(star_discrepancy(halton_points(16)), 29.0 / 144, 1e-12);
  EXPECT_NEAR(star_discrepancy(halton_points(64)), 5.0 / 96, 1e-12);
  EXPECT_NEAR(star_discrepancy(halton_points(256)), 389.0 / 20736, 1e-12);
  EXPECT_NEAR(star_discrepancy(halton_points(1024)), 0.006836, 5e-7);
}

// N D* = m/3 + 13/9 - (-1)^m 4 / (9 2^m) for N = 2^m.
TEST(Discrepancy, HammersleyHasItsClosedForm) {
  for (uint32_t m = 2; m <= 10; ++m) {
    const double n = 1U << m, sign = m % 2 == 0 ? 1 : -1;
    EXPECT_NEAR(star_discrepancy(hammersley_points(1U << m)), (m / 3.0 + 13.0 / 9 - sign * 4 / (9 * n)) / n, 1e-12)
        << m;
  }
}

TEST(Discrepancy, GridsHaveTheirExactValues) {
  EXPECT_NEAR(star_discrepancy(regular_grid_points(8, 0.5)), 31.0 / 256, 1e-12);  // 1 / m - 1 / (4 m^2)
  EXPECT_NEAR(star_discrepancy(regular_grid_points(8, 0)), 15.0 / 64, 1e-12);
  EXPECT_NEAR(l2_star_discrepancy(regular_grid_points(4, 0.5)), std::sqrt(263.0 / 73728), 1e-12);
  EXPECT_NEAR(l2_star_discrepancy(regular_grid_points(8, 0.5)), std::sqrt(1031.0 / 1179648), 1e-12);
}

TEST(Discrepancy, WarnocksFormulaHasTheExactValues) {
  EXPECT_NEAR(l2_star_discrepancy(hammersley_points(16)), std::sqrt(22655.0 / 4718592), 1e-12);
  EXPECT_NEAR(l2_star_discrepancy(halton_points(16)), std::sqrt(1159.0 / 248832), 1e-12);
  EXPECT_NEAR(l2_star_discrepancy(hammersley_points(64)), std::sqrt(543167.0 / 1207959552), 1e-12);
  EXPECT_NEAR(l2_star_discrepancy(halton_points(64)), std::sqrt(115781.0 / 429981696), 1e-12);
}

TEST(Discrepancy, ZarembaHasTheKnownValues) { EXPECT_NEAR(star_discrepancy(zaremba_points(64)), 0.057190, 1e-6); }

// All pairs of coordinates as sides, with the counts of open and closed boxes.
double extreme_by_search(const PointSet& set) {
  std::array<std::vector<double>, 2> sides{{{0, 1}, {0, 1}}};
  for (const PlanePoint& p : set)
    for (size_t axis = 0; axis < 2; ++axis) sides[axis].push_back(p[axis]);
  double most = 0;
  const auto n = static_cast<double>(set.size());
  for (const double x0 : sides[0])
    for (const double x1 : sides[0])
      for (const double y0 : sides[1])
        for (const double y1 : sides[1]) {
          if (x1 < x0 || y1 < y0) continue;
          double open = 0, closed = 0;
          for (const PlanePoint& p : set) {
            open += p[0] > x0 && p[0] < x1 && p[1] > y0 && p[1] < y1 ? 1 : 0;
            closed += p[0] >= x0 && p[0] <= x1 && p[1] >= y0 && p[1] <= y1 ? 1 : 0;
          }
          const double area = (x1 - x0) * (y1 - y0);
          most = std::max({most, area - open / n, closed / n - area});
        }
  return most;
}

TEST(Discrepancy, ExtremeEqualsASearchOverAllBoxes) {
  for (uint64_t seed = 0; seed < 5; ++seed)
    EXPECT_NEAR(extreme_discrepancy(random_set(12, seed)), extreme_by_search(random_set(12, seed)), 1e-12) << seed;
  EXPECT_NEAR(extreme_discrepancy(hammersley_points(16)), extreme_by_search(hammersley_points(16)), 1e-12);
  EXPECT_NEAR(extreme_discrepancy(regular_grid_points(4, 0)), extreme_by_search(regular_grid_points(4, 0)), 1e-12);
}

// D* <= D <= 4 D*                                                                                   [Lang, eq. 7.17]
TEST(Discrepancy, ExtremeLiesBetweenItsBounds) {
  for (const PointSet& set :
       {halton_points(64), hammersley_points(64), regular_grid_points(8, 0.5), random_set(64, 1)}) {
    EXPECT_LE(star_discrepancy(set), extreme_discrepancy(set) + 1e-12);
    EXPECT_LE(extreme_discrepancy(set), 4 * star_discrepancy(set) + 1e-12);
  }
}

TEST(Discrepancy, SequencesStayBelowTheirBounds) {
  EXPECT_NEAR(halton_bound(16), 1.114564, 1e-6);
  EXPECT_NEAR(hammersley_bound(16), 0.343750, 1e-6);
  EXPECT_NEAR(halton_bound(256), 0.159222, 1e-6);
  EXPECT_NEAR(hammersley_bound(1024), 0.008301, 1e-6);
  for (const uint32_t n : {16U, 64U, 256U, 1024U}) {
    EXPECT_LT(star_discrepancy(halton_points(n)), halton_bound(n));
    EXPECT_LT(star_discrepancy(hammersley_points(n)), hammersley_bound(n));
  }
}

TEST(NetQuality, IsThatOfKnownSets) {
  EXPECT_EQ(net_quality(hammersley_points(64), 2), 0);
  EXPECT_EQ(net_quality(regular_grid_points(8, 0.5), 2), 3);
  EXPECT_EQ(net_quality(halton_points(64), 2), 6);
  EXPECT_EQ(net_quality(halton_points(63), 2), std::nullopt);
  PointSet diagonal, base3;
  for (int i = 0; i < 16; ++i) diagonal.push_back({i / 16.0, i / 16.0});
  EXPECT_EQ(net_quality(diagonal, 2), 3);
  for (uint32_t i = 0; i < 27; ++i) base3.push_back({i / 27.0, HaltonSampler::radical_inverse(i, 3)});
  EXPECT_EQ(net_quality(base3, 3), 0);
}

// The first N = 2^m points of a digital sequence in the given number of dimensions, with i / N as a further coordinate: a
// (t, m, s + 1)-net for every m if and only if the sequence is a (t, s)-sequence [Niederreiter 1992, sec. 4.3].
std::vector<std::vector<double>> first_points(uint32_t (*coordinate)(uint32_t, uint32_t), int m, uint32_t dimensions) {
  std::vector<std::vector<double>> points(1U << m);
  for (uint32_t i = 0; i < points.size(); ++i) {
    for (uint32_t k = 0; k < dimensions; ++k) points[i].push_back(coordinate(i, k) * 0x1p-32);
    points[i].push_back(static_cast<double>(i) / static_cast<double>(points.size()));
  }
  return points;
}

// t of both sequences in base 2 is at most the sum of the degrees of their polynomials minus one: 0, 0, 1, 3, 5 for 1 to 5
// dimensions [Sobol' 1967; Niederreiter 1988], and is
// reached; in 5 dimensions that needs more points.
TEST(NetQuality, OfSequencesIsThePublishedOne) {
  constexpr int kPublished[] = {0, 0, 0, 1, 3, 5};
  for (const auto& coordinate : {NiederreiterSampler::point, SobolSampler::point})
    for (uint32_t s = 1; s <= 5; ++s) {
      int most = 0;
      for (int m = 1; m <= 11; ++m) {
        const int t = *net_quality(first_points(coordinate, m, s), 2);
        EXPECT_LE(t, kPublished[s]) << s << " dimensions, m = " << m;
        most = std::max(most, t);
      }
      if (s < 5) {
        EXPECT_EQ(most, kPublished[s]) << s;
      }
    }
}

TEST(Distances, AreThoseOfKnownSets) {
  EXPECT_NEAR(least_distance(hammersley_points(16)), 0.176777, 1e-6);
  EXPECT_NEAR(least_distance(halton_points(64)), 0.0484735, 1e-7);
  EXPECT_NEAR(least_toroidal_distance(regular_grid_points(8, 0)), 0.125, 1e-12);
  EXPECT_NEAR(least_toroidal_distance(PointSet{{0.05, 0.5}, {0.95, 0.5}}), 0.1, 1e-12);
  EXPECT_NEAR(least_distance(PointSet{{0.05, 0.5}, {0.95, 0.5}}), 0.9, 1e-12);
}

double area_of(const PointSet& polygon) {
  double twice = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const PlanePoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * twice;
}

TEST(VoronoiCells, DivideTheSquare) {
  for (const PointSet& set : {hammersley_points(64), random_set(50, 3)}) {
    double sum = 0;
    for (const PointSet& cell : voronoi_cells(set)) sum += area_of(cell);
    EXPECT_NEAR(sum, 1, 1e-12);
  }
  for (const PointSet& cell : voronoi_cells(regular_grid_points(8, 0.5))) EXPECT_NEAR(area_of(cell), 1.0 / 64, 1e-12);
}

TEST(Periodogram, HasTheClosedFormsOfGridsAndHammersley) {
  const Periodogram regular = periodogram(regular_grid_points(8, 0), 16);
  for (int ky = -16; ky <= 16; ++ky)
    for (int kx = -16; kx <= 16; ++kx)
      EXPECT_NEAR(regular.at(kx, ky), kx % 8 == 0 && ky % 8 == 0 ? 64 : 0, 1e-9) << kx << " " << ky;
  const Periodogram set = periodogram(hammersley_points(64), 16);
  EXPECT_NEAR(set.at(6, -12), 20.41, 0.005);
  EXPECT_NEAR(set.at(14, -14), 15.41, 0.005);
  EXPECT_NEAR(set.at(10, 10), 13.48, 0.005);
  EXPECT_NEAR(periodogram(halton_points(64), 16).at(3, -10), 26.84, 0.005);
}

// The mean of 400 jittered grids: 1 - sinc^2(k1 / 8) sinc^2(k2 / 8). P is approximately exponential, with a standard
// deviation not above its mean, so that six comparisons with 4 standard errors fail in 4e-4 of all cases. The seed is
// fixed.
TEST(Periodogram, OfJitteredGridsHasItsExpectedValue) {
  constexpr int kSets = 400;
  std::vector<PointSet> sets;
  for (uint64_t i = 0; i < kSets; ++i)
    sets.push_back(*points_of({.sampler = "stratified", .settings = {{"side", Value(int64_t{8})}}, .seed = i}));
  const Periodogram mean = mean_periodogram(sets, 8);
  const auto sinc2 = [](double x) {
    return x == 0 ? 1 : std::pow(std::sin(std::numbers::pi * x) / (std::numbers::pi * x), 2);
  };
  for (const auto& [kx, ky] :
       {std::pair(1, 0), std::pair(2, 0), std::pair(4, 0), std::pair(8, 0), std::pair(4, 4), std::pair(1, 1)}) {
    const double expected = 1 - sinc2(kx / 8.0) * sinc2(ky / 8.0);
    EXPECT_NEAR(mean.at(kx, ky), expected, 4 * expected / std::sqrt(kSets)) << kx << " " << ky;
  }
}

TEST(RadialSpectrum, IsFlatForAFlatSpectrum) {
  Periodogram flat{.extent = 8, .power = std::vector<double>(17 * 17, 2.0)};
  const RadialSpectrum radial = radial_spectrum(flat);
  ASSERT_EQ(radial.mean.size(), 8u);
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_DOUBLE_EQ(radial.mean[i], 2);
    EXPECT_NEAR(radial.anisotropy[i], 0, 1e-12);
  }
}

TEST(PatternReport, ErrorsStayBelowTheBoundOfKoksmaAndHlawka) {
  const auto value = [](const std::vector<QualityValue>& values, const std::string& name) {
    for (const QualityValue& v : values)
      if (v.name == name) return v.mean;
    return std::nan("");
  };
  for (const auto& [n, error] : {std::pair(16U, 9.7656e-4), std::pair(64U, 3.96729e-3), std::pair(256U, 1.956939e-3)}) {
    const auto values = report_of({hammersley_points(n)});
    EXPECT_NEAR(value(values, "error of x y"), error, 1e-6 * error + 5e-9) << n;
    EXPECT_LE(value(values, "error of x y"), value(values, "error of x y, bound"));
  }
  EXPECT_NEAR(value(report_of({halton_points(64)}), "error of exp(x + y)"), 0.091217, 1e-6);
  EXPECT_NEAR(value(report_of({halton_points(64)}), "error of exp(x + y), bound"), 0.640315, 1e-6);
}

CubePoints cube_of(const PointSet& set) {
  CubePoints points;
  for (const PlanePoint& p : set) points.push_back({p[0], p[1]});
  return points;
}

// With all coordinates on the grid, both bounds are the star discrepancy; with fewer, they enclose it.
TEST(CubeDiscrepancy, BoundsEncloseTheExactValueInThePlane) {
  for (const PointSet& set : {halton_points(64), hammersley_points(64), regular_grid_points(8), zaremba_points(50)}) {
    const double exact = star_discrepancy(set);
    const Bounds all = star_discrepancy_bounds(cube_of(set));
    EXPECT_NEAR(all.lower, exact, 1e-12);
    EXPECT_NEAR(all.upper, exact, 1e-12);
    for (const double corners : {4.0, 100.0, 900.0}) {
      const Bounds some = star_discrepancy_bounds(cube_of(set), corners);
      EXPECT_LE(some.lower, exact + 1e-12) << corners;
      EXPECT_GE(some.upper, exact - 1e-12) << corners;
    }
    EXPECT_NEAR(l2_star_discrepancy(cube_of(set)), l2_star_discrepancy(set), 1e-12);
    EXPECT_NEAR(least_distance(cube_of(set)), least_distance(set), 1e-12);
    EXPECT_NEAR(least_toroidal_distance(cube_of(set)), least_toroidal_distance(set), 1e-12);
  }
}

// One point (x, ..., x): a box that just leaves it out has the volume x, one that just contains it x^s.
TEST(CubeDiscrepancy, OfOnePoint) {
  for (const double x : {0.3, 0.5, 0.9})
    for (const size_t s : {1U, 3U, 5U}) {
      const CubePoints point{std::vector<double>(s, x)};
      const double exact = std::max(x, 1 - std::pow(x, static_cast<double>(s)));
      const Bounds bounds = star_discrepancy_bounds(point);
      EXPECT_NEAR(bounds.lower, exact, 1e-12) << x << " " << s;
      EXPECT_NEAR(bounds.upper, exact, 1e-12) << x << " " << s;
      const double n = static_cast<double>(s);
      const double square = std::pow(3.0, -n) - std::pow(2.0, 1 - n) * std::pow(1 - x * x, n) + std::pow(1 - x, n);
      EXPECT_NEAR(l2_star_discrepancy(point), std::sqrt(square), 1e-12);
    }
}

// Points on one axis, as a set of dimension 1: 1/(2N) + max |x_i - (2i - 1)/(2N)| [Niederreiter 1992].
TEST(CubeDiscrepancy, OfMidpointsOnALine) {
  CubePoints points;
  for (int i = 0; i < 10; ++i) points.push_back({(i + 0.5) / 10});
  EXPECT_NEAR(star_discrepancy_bounds(points).lower, 0.05, 1e-12);
  EXPECT_NEAR(star_discrepancy_bounds(points).upper, 0.05, 1e-12);
}

TEST(CubeDiscrepancy, BoundsApproachEachOther) {
  const CubePoints points =
      *cube_points_of({.sampler = "sobol", .count = 256, .dimensions = {0, 1, 2}});
  double gap = 1;
  for (const double corners : {1e3, 1e4, 1e5, 1e6}) {
    const Bounds bounds = star_discrepancy_bounds(points, corners);
    EXPECT_LE(bounds.lower, bounds.upper);
    EXPECT_LT(bounds.upper - bounds.lower, gap);
    gap = bounds.upper - bounds.lower;
  }
  EXPECT_LT(gap, 0.03);
}

TEST(SamplerPoints, ReportErrors) {
  EXPECT_NE(points_of({.sampler = "magic"}).error().message.find("there is no sampler 'magic'"), std::string::npos);
  EXPECT_FALSE(points_of({.sampler = "sobol", .count = 0}));
  EXPECT_FALSE(points_of({.sampler = "sobol", .dimensions = {0, kMostDimensions}}));
  EXPECT_TRUE(points_of({.sampler = "sobol", .dimensions = {9998, 9999}}));
}

}  // namespace
}  // namespace etendue::patterns
