// Directions to a triangle, all equally likely: against closed forms, against its density, against points on its area.
#include "light/spherical_triangle.h"

#include <gtest/gtest.h>

#include <random>

#include "base/warp.h"
#include "light/light_table.h"
#include "support/chi_square.h"

namespace etendue {
namespace {

struct Corners {
  Vec3 p0, p1, p2;

  SphericalTriangle seen() const { return {p0, p1 - p0, p2 - p0}; }
  // Whether a direction leads to it.
  bool holds(const Vec3& w) const {
    const auto side = [&](const Vec3& a, const Vec3& b) { return glm::dot(glm::cross(a, b), w); };
    const float s0 = side(p0, p1), s1 = side(p1, p2), s2 = side(p2, p0);
    return (s0 > 0 && s1 > 0 && s2 > 0) || (s0 < 0 && s1 < 0 && s2 < 0);
  }
};

const Corners kTriangles[] = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},                // an octant
    {{-1, 1, 0.2f}, {2, 1, -0.5f}, {0.3f, 0.4f, 2}},  // close by
    {{5, 1, 5}, {-5, 1, 5}, {0, 1, -5}},              // almost half of all directions
    {{0, 1, 0}, {0.2f, 1, 0}, {0, 1.1f, 0.15f}},      // small
    {{0, 3, 0}, {0.02f, 3, 4}, {0, 3.1f, 4}},         // a splinter
};

TEST(SphericalTriangle, KnowsItsSolidAngle) {
  EXPECT_NEAR(kTriangles[0].seen().solid_angle(), kPi / 2, 1e-6f);
  // A face of a cube, seen from its middle, is a sixth of the sphere; half of it a twelfth.
  const Corners half{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}};
  EXPECT_NEAR(half.seen().solid_angle(), kPi / 3, 1e-6f);
  // Far away it is the area over the square of the distance.
  for (const float d : {1e2f, 1e4f, 1e6f}) {
    const Corners far{{0, 0, d}, {1, 0, d}, {0, 1, d}};
    EXPECT_NEAR(far.seen().solid_angle() * 2 * d * d, 1, 1e-3f) << d;
  }
}

TEST(SphericalTriangle, FindsPointsOnItselfInTheirDirection) {
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

// Cut into n^2 smaller ones of the same shape, each must be met as often as its solid angle says.
TEST(SphericalTriangle, FindsEveryDirectionAlike) {
  constexpr int kSides = 6, kSamples = 50000;
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> uniform(0, kOneMinusEpsilon);
  for (const Corners& t : kTriangles) {
    const SphericalTriangle seen = t.seen();
    if (!seen.can_be_sampled()) continue;
    std::array<int, 2 * kSides * kSides> met{};
    const auto cell = [](int i, int j, bool upper) {
      return static_cast<size_t>(2 * (i * kSides + j) + (upper ? 1 : 0));
    };
    for (int k = 0; k < kSamples; ++k) {
      const Vec2 b = seen.sample({uniform(engine), uniform(engine)}).barycentric * static_cast<float>(kSides);
      const int i = std::min(static_cast<int>(b.x), kSides - 1), j = std::min(static_cast<int>(b.y), kSides - 1);
      ++met[cell(i, j, b.x - static_cast<float>(i) + b.y - static_cast<float>(j) > 1)];
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
          statistic += sqr(met[cell(i, j, upper)] - share * kSamples) / (share * kSamples), ++cells;
        }
    EXPECT_EQ(cells, kSides * kSides);
    EXPECT_GT(test::chi_square_tail(statistic, cells - 1), 0.01 / std::size(kTriangles))
        << "from a solid angle of " << seen.solid_angle();
  }
}

// Integrals over directions are those over the area, weighted: z-tests of the means of some functions.
TEST(SphericalTriangle, EstimatesWhatPointsOnItsAreaDo) {
  constexpr int kSamples = 200000;
  std::mt19937 engine(4);
  std::uniform_real_distribution<float> uniform(0, kOneMinusEpsilon);
  const auto functions = [](const Vec3& w) { return std::array<double, 3>{w.x, w.y * w.y, w.x * w.z + 1}; };
  for (const Corners& t : kTriangles) {
    const SphericalTriangle seen = t.seen();
    const Vec3 cross = glm::cross(t.p1 - t.p0, t.p2 - t.p0);
    std::array<std::array<double, 3>, 2> sum{}, squares{};
    for (int i = 0; i < kSamples; ++i) {
      const Vec2 b = square_to_triangle({uniform(engine), uniform(engine)});
      const Vec3 to = t.p0 + b.x * (t.p1 - t.p0) + b.y * (t.p2 - t.p0);
      const float d = glm::length(to);
      const auto by_area = functions(to / d);
      const auto by_direction = functions(seen.sample({uniform(engine), uniform(engine)}).direction);
      const double jacobian = 0.5 * static_cast<double>(std::abs(glm::dot(cross, to)) / (d * d * d));
      for (size_t k = 0; k < 3; ++k) {
        const double a = by_area[k] * jacobian, s = by_direction[k] * static_cast<double>(seen.solid_angle());
        sum[0][k] += a, squares[0][k] += a * a, sum[1][k] += s, squares[1][k] += s * s;
      }
    }
    for (size_t k = 0; k < 3; ++k) {
      double variance = 0;
      for (size_t w = 0; w < 2; ++w) variance += (squares[w][k] / kSamples - sqr(sum[w][k] / kSamples)) / kSamples;
      // 1 % for all fifteen.
      EXPECT_LT(std::abs(sum[0][k] - sum[1][k]) / kSamples, 3.4 * std::sqrt(variance) + 1e-7);
    }
  }
}

// Near a panel the table samples directions, farther off points; what it says of either is the same.
TEST(SphericalTriangle, IsSampledWhereItLooksLarge) {
  AreaLightTriangle panel;
  panel.radiance = Rgb(1), panel.double_sided = true;
  panel.place({{-1, 1, -1}, {1, 1, -1}, {-1, 1, 1}, 1});
  Bounds bounds;
  bounds.extend(Vec3(-5)), bounds.extend(Vec3(5));
  const LightTable table({panel}, {}, Environment{}, bounds);
  constexpr size_t kCount = 992;
  auto from = std::make_unique<Vec3Lanes<kCount>>();
  std::vector<float> zero(kCount, 0), u0(kCount), u1(kCount);
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> uniform(0, kOneMinusEpsilon);
  for (size_t i = 0; i < kCount; ++i) {
    from->set(i, 4.0f * (Vec3(uniform(engine), uniform(engine), uniform(engine)) - 0.5f));
    u0[i] = uniform(engine), u1[i] = uniform(engine);
  }
  std::vector<LightSample> samples(kCount), by_area(kCount);
  table.sample({*from, zero.data(), u0.data(), u1.data(), kCount}, samples.data(), LightStrategy::one);
  table.sample({*from, zero.data(), u0.data(), u1.data(), kCount}, by_area.data(), LightStrategy::emission_pdf);
  int large = 0;
  for (size_t i = 0; i < kCount; ++i) {
    const auto check = [&](const LightSample& s, LightStrategy strategy) {
      const Vec3 at = (*from)[i] + s.wi * s.distance;
      EXPECT_LT(std::abs(at.y - 1), 2e-5f);
      if (s.pdf > 0) {
        EXPECT_NEAR(table.pdf_triangle(0, (*from)[i], at, 0, strategy) / s.pdf, 1, 2e-3f);
      }
    };
    check(samples[i], LightStrategy::one), check(by_area[i], LightStrategy::emission_pdf);
    if (samples[i].pdf != by_area[i].pdf) {
      ++large;
      EXPECT_NEAR(samples[i].pdf * SphericalTriangle(panel.p0 - (*from)[i], panel.e1, panel.e2).solid_angle(), 1,
                  1e-5f);
    }
  }
  EXPECT_GT(large, 50);
  EXPECT_LT(large, 500);
}

}  // namespace
}  // namespace etendue
