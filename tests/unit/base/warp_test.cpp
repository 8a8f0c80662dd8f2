// Maps from the unit square: special points, densities, and equality of the scalar and the vectorised versions.
#include "base/warp.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "equations/pearson_test.h"

namespace etendue {
namespace {

std::vector<Vec2> random_points(int count) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(std::min(uniform(engine), kOneMinusEpsilon), std::min(uniform(engine), kOneMinusEpsilon));
  return points;
}

TEST(CosSinOfOctant, HasSevenCorrectDigits) {
  for (int i = -1000; i <= 1000; ++i) {
    const float x = kPi / 4 * static_cast<float>(i) / 1000;
    const Vec2 v = cos_sin_of_octant(x);
    EXPECT_NEAR(v.x, std::cos(double{x}), 2e-7);
    EXPECT_NEAR(v.y, std::sin(double{x}), 2e-7);
  }
}

TEST(SquareToDisk, MapsTheCentreAndTheSides) {
  EXPECT_EQ(square_to_disk(Vec2(0.5f)), Vec2(0));
  for (const float t : {0.0f, 0.3f, 0.5f, 0.9f}) {
    EXPECT_NEAR(glm::length(square_to_disk({t, 0})), 1, 1e-6) << "sides of the square map to the circle";
    EXPECT_NEAR(glm::length(square_to_disk({kOneMinusEpsilon, t})), 1, 1e-6);
  }
  EXPECT_NEAR(square_to_disk({kOneMinusEpsilon, 0.5f}).x, 1, 1e-6);
  EXPECT_NEAR(square_to_disk({0.5f, kOneMinusEpsilon}).y, 1, 1e-6);
}

// Chi-square test with cells of equal area (rings times sectors), significance level 1 %.
TEST(SquareToDisk, IsUniform) {
  constexpr int kRings = 8, kSectors = 8, kPoints = 100'000;
  std::array<int, kRings * kSectors> counts{};
  for (const Vec2& u : random_points(kPoints)) {
    const Vec2 d = square_to_disk(u);
    const int ring = std::min(kRings - 1, static_cast<int>(kRings * glm::dot(d, d)));
    const int sector = std::min(kSectors - 1, static_cast<int>((std::atan2(d.y, d.x) / (2 * kPi) + 0.5f) * kSectors));
    ++counts[static_cast<size_t>(ring * kSectors + sector)];
  }
  const double expected = double{kPoints} / static_cast<double>(counts.size());
  double statistic = 0;
  for (const int n : counts) statistic += sqr(n - expected) / expected;
  EXPECT_GT(equations::chi_square_survival(statistic, static_cast<int>(counts.size()) - 1), 0.01);
}

TEST(SquareToTriangle, StaysInsideAndHasTheCentroidAsMean) {
  Vec2 sum(0);
  const auto points = random_points(20'000);
  for (const Vec2& u : points) {
    const Vec2 b = square_to_triangle(u);
    ASSERT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1) << b.x << ' ' << b.y;
    sum += b;
  }
  // Four standard errors of the mean; a coordinate has the variance 1/18.
  const float margin = 4 * std::sqrt(1 / 18.0f / static_cast<float>(points.size()));
  EXPECT_NEAR(sum.x / static_cast<float>(points.size()), 1 / 3.0f, margin);
  EXPECT_NEAR(sum.y / static_cast<float>(points.size()), 1 / 3.0f, margin);
}

TEST(SquaresToCosineHemisphere, EqualsTheScalarVersion) {
  constexpr size_t kPoints = 77;
  alignas(64) std::array<float, 80> u0{}, u1{};
  const auto points = random_points(kPoints);
  for (size_t i = 0; i < kPoints; ++i) {
    u0[i] = points[i].x;
    u1[i] = points[i].y;
  }
  Vec3Lanes<80> directions;
  squares_to_cosine_hemisphere(u0.data(), u1.data(), kPoints, directions);
  for (size_t i = 0; i < kPoints; ++i) EXPECT_EQ(directions[i], square_to_cosine_hemisphere(points[i]));
}

}  // namespace
}  // namespace etendue
