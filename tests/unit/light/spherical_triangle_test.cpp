// Uniform sampling of the solid angle of a triangle, compared with closed forms, with its density, and with uniform
// sampling of the area.
#include "light/sampling/spherical_triangle.h"

#include <gtest/gtest.h>

#include <random>

#include "base/warp.h"
#include "equations/pearson_test.h"
#include "unit/light/light_queries.h"

namespace etendue::spherical_triangle_test {
namespace {

struct Corners {
  Vec3 p0, p1, p2;

  SphericalTriangle seen() const { return {p0, p1 - p0, p2 - p0}; }
};

const Corners kTriangles[] = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},                // an octant
    {{-1, 1, 0.2f}, {2, 1, -0.5f}, {0.3f, 0.4f, 2}},  // near
    {{5, 1, 5}, {-5, 1, 5}, {0, 1, -5}},              // almost half of all directions
    {{0, 1, 0}, {0.2f, 1, 0}, {0, 1.1f, 0.15f}},      // small
    {{0, 3, 0}, {0.02f, 3, 4}, {0, 3.1f, 4}},         // a sliver
};

TEST(SphericalTriangle, SolidAngle) {
  EXPECT_NEAR(kTriangles[0].seen().solid_angle(), kPi / 2, 1e-6f);
  // A face of a cube, seen from the centre, subtends a sixth of the sphere; half of it a twelfth.
  const Corners half{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}};
  EXPECT_NEAR(half.seen().solid_angle(), kPi / 3, 1e-6f);
  // At a distance it is the area over the squared distance.
  for (const float d : {1e2f, 1e4f, 1e6f}) {
    const Corners far{{0, 0, d}, {1, 0, d}, {0, 1, d}};
    EXPECT_NEAR(far.seen().solid_angle() * 2 * d * d, 1, 1e-3f) << d;
  }
}

TEST(SphericalTriangle, SamplesPointsOfTheTriangleInTheirDirection) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<float> uniform(0, kOneMinusEpsilon);
  for (const float scale : {1e-4f, 1.0f, 1e5f})
    for (const Corners& unit : kTriangles) {
      const Corners t{scale * unit.p0, scale * unit.p1, scale * unit.p2};
      const SphericalTriangle seen = t.seen();
      for (int i = 0; i < 2000; ++i) {
        const auto p = seen.sample({uniform(engine), uniform(engine)});
        const Vec3 point = t.p0 + p.barycentric.x * (t.p1 - t.p0) + p.barycentric.y * (t.p2 - t.p0);
        ASSERT_LT(glm::distance(point, p.direction * p.distance), 1e-5f * scale);
        ASSERT_GE(std::min({p.barycentric.x, p.barycentric.y, 1 - p.barycentric.x - p.barycentric.y}), -1e-6f);
      }
    }
}

// Chi-square test over n^2 congruent parts, each with its solid angle as expectation. The false-alarm rate is 1 % over
// all triangles.
TEST(SphericalTriangle, DirectionsAreUniform) {
  constexpr int kSides = 6;
  constexpr int kSamples = 50000;
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> uniform(0, kOneMinusEpsilon);
  for (const Corners& t : kTriangles) {
    const SphericalTriangle seen = t.seen();
    if (!seen.can_be_sampled()) continue;
    std::array<int, 2 * kSides * kSides> counts{};
    const auto cell = [](int i, int j, bool upper) {
      return static_cast<size_t>(2 * (i * kSides + j) + (upper ? 1 : 0));
    };
    for (int k = 0; k < kSamples; ++k) {
      const Vec2 b = seen.sample({uniform(engine), uniform(engine)}).barycentric * static_cast<float>(kSides);
      const int i = std::min(static_cast<int>(b.x), kSides - 1);
      const int j = std::min(static_cast<int>(b.y), kSides - 1);
      ++counts[cell(i, j, b.x - static_cast<float>(i) + b.y - static_cast<float>(j) > 1)];
    }
    const auto corner = [&](int i, int j) {
      const Vec2 b = Vec2(i, j) / static_cast<float>(kSides);
      return t.p0 + b.x * (t.p1 - t.p0) + b.y * (t.p2 - t.p0);
    };
    double statistic = 0;
    int cells = 0;
    for (int i = 0; i < kSides; ++i)
      for (int j = 0; i + j < kSides; ++j)
        for (const bool upper : {false, true}) {
          if (upper && i + j + 1 == kSides) continue;
          const Corners part = upper ? Corners{corner(i + 1, j + 1), corner(i, j + 1), corner(i + 1, j)}
                                     : Corners{corner(i, j), corner(i + 1, j), corner(i, j + 1)};
          const double share = static_cast<double>(part.seen().solid_angle() / seen.solid_angle());
          statistic += sqr(counts[cell(i, j, upper)] - share * kSamples) / (share * kSamples);
          ++cells;
        }
    EXPECT_EQ(cells, kSides * kSides);
    EXPECT_GT(equations::chi_square_survival(statistic, cells - 1), 0.01 / std::size(kTriangles))
        << "solid angle " << seen.solid_angle();
  }
}

// Integrals over directions equal weighted integrals over the area: z-tests of the means of three functions with a
// false-alarm rate of 1 % over all triangles and functions.
TEST(SphericalTriangle, IntegralsEqualThoseOverTheArea) {
  constexpr int kSamples = 200000;
  std::mt19937 engine(4);
  std::uniform_real_distribution<float> uniform(0, kOneMinusEpsilon);
  const auto functions = [](const Vec3& w) { return std::array<double, 3>{w.x, w.y * w.y, w.x * w.z + 1}; };
  for (const Corners& t : kTriangles) {
    const SphericalTriangle seen = t.seen();
    const Vec3 cross = glm::cross(t.p1 - t.p0, t.p2 - t.p0);
    std::array<std::array<double, 3>, 2> sum{};
    std::array<std::array<double, 3>, 2> squares{};
    for (int i = 0; i < kSamples; ++i) {
      const Vec2 b = square_to_triangle({uniform(engine), uniform(engine)});
      const Vec3 to = t.p0 + b.x * (t.p1 - t.p0) + b.y * (t.p2 - t.p0);
      const float d = glm::length(to);
      const auto by_area = functions(to / d);
      const auto by_direction = functions(seen.sample({uniform(engine), uniform(engine)}).direction);
      const double jacobian = 0.5 * static_cast<double>(std::abs(glm::dot(cross, to)) / (d * d * d));
      for (size_t k = 0; k < 3; ++k) {
        const double a = by_area[k] * jacobian;
        const double s = by_direction[k] * static_cast<double>(seen.solid_angle());
        sum[0][k] += a;
        squares[0][k] += a * a;
        sum[1][k] += s;
        squares[1][k] += s * s;
      }
    }
    for (size_t k = 0; k < 3; ++k) {
      double variance = 0;
      for (size_t w = 0; w < 2; ++w) variance += (squares[w][k] / kSamples - sqr(sum[w][k] / kSamples)) / kSamples;
      EXPECT_LT(std::abs(sum[0][k] - sum[1][k]) / kSamples, 3.4 * std::sqrt(variance) + 1e-7);
    }
  }
}

// The light table samples directions to a large triangle and points on a small one; the densities agree in both cases.
TEST(SphericalTriangle, IsUsedForLargeTriangles) {
  const AreaLightTriangle panel = test::triangle({-1, 1, -1}, {1, 1, -1}, {-1, 1, 1}, 1, true);
  const LightTable table({panel}, {}, Environment{}, test::bounds(Vec3(-5), Vec3(5)));
  test::Receivers receivers;
  test::RandomNumbers random(5);
  receivers.draw(random, Vec3(0), 2);
  const auto samples = receivers.sample(table);
  const auto by_area = receivers.sample(table, LightStrategy::emission_pdf);
  int large = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    const auto check = [&](const LightSample& s, LightStrategy strategy) {
      const Vec3 at = receivers.from[i] + s.wi * s.distance;
      EXPECT_LT(std::abs(at.y - 1), 2e-5f);
      if (s.pdf > 0) {
        EXPECT_NEAR(table.pdf_triangle(0, receivers.from[i], at, 0, strategy) / s.pdf, 1, 2e-3f);
      }
    };
    check(samples[i], LightStrategy::one);
    check(by_area[i], LightStrategy::emission_pdf);
    if (samples[i].pdf != by_area[i].pdf) {
      ++large;
      EXPECT_NEAR(samples[i].pdf * SphericalTriangle(panel.p0 - receivers.from[i], panel.e1, panel.e2).solid_angle(), 1,
                  1e-5f);
    }
  }
  EXPECT_GT(large, 50);
  EXPECT_LT(large, 500);
}

}  // namespace
}  // namespace etendue::spherical_triangle_test
