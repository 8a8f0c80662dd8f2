// Equiangular distances: the density integrates to one and is that of the samples.
#include "medium/equiangular.h"

#include <gtest/gtest.h>

namespace etendue {
namespace {

struct Ray {
  const char* name;
  float from, to;
  Vec3 point;
};

TEST(Equiangular, SamplesFollowTheDensity) {
  for (const Ray& ray : {Ray{"beside", 0, 10, {1, 0, 5}}, Ray{"behind the start", 2, 9, {0.5f, 0.5f, -3}},
                         Ray{"beyond the end", 0, 3, {0, 2, 8}}, Ray{"infinite", 1, kInfinity, {0, 1, 4}},
                         Ray{"near the ray", 0, 6, {0.02f, 0, 2}}}) {
    const EquiangularDistance distances(Vec3(0), {0, 0, 1}, {ray.from, ray.to}, ray.point);
    // The integral of the density between two samples is the difference of their random numbers.
    constexpr int kParts = 50, kSteps = 2000;
    for (int part = 1; part < kParts - 1; ++part) {
      const float u0 = static_cast<float>(part) / kParts, u1 = static_cast<float>(part + 1) / kParts;
      const double a = distances.sample(u0), b = distances.sample(u1);
      ASSERT_LT(a, b) << ray.name;
      double sum = 0;
      for (int i = 0; i < kSteps; ++i)
        sum += static_cast<double>(distances.pdf(static_cast<float>(a + (b - a) * (i + 0.5) / kSteps)));
      EXPECT_NEAR(sum * (b - a) / kSteps, 1.0 / kParts, 1e-3 / kParts) << ray.name;
    }
    EXPECT_GE(distances.sample(0), ray.from) << ray.name;
    EXPECT_LE(distances.sample(0.99999994f), ray.to) << ray.name;
  }
}

// A light on the ray: finite densities.
TEST(Equiangular, PointOnTheRay) {
  const EquiangularDistance distances(Vec3(0), {0, 0, 1}, {0, 4}, {0, 0, 2});
  for (const float u : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    const float t = distances.sample(u);
    EXPECT_TRUE(t >= 0 && t <= 4);
    EXPECT_TRUE(std::isfinite(distances.pdf(t)));
  }
}

// Points of the ray are in the interval if and only if they are in the cone.
TEST(Equiangular, InsideCone) {
  uint32_t state = 1;
  const auto random = [&] {
    state = state * 1664525U + 1013904223U;
    return 2 * (static_cast<float>(state >> 8) / 16777216.0f) - 1;
  };
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 origin(3 * random(), 3 * random(), 3 * random()), apex(random(), random(), random());
    const Vec3 direction = glm::normalize(Vec3(random(), random(), random()) + Vec3(1e-3f, 0, 0)),
               axis = glm::normalize(Vec3(random(), random(), random()) + Vec3(0, 1e-3f, 0));
    const float cosine = 0.05f + 0.9f * std::abs(random());
    const DistanceInterval lit = inside_cone(origin, direction, {0, 10}, apex, axis, cosine);
    for (float t = 0.05f; t < 10; t += 0.1f) {
      const Vec3 x = origin + direction * t - apex;
      const float margin = glm::dot(x, axis) - cosine * glm::length(x);
      if (std::abs(margin) < 1e-3f) continue;
      EXPECT_EQ(t > lit.from && t<lit.to, margin> 0);
      inside += margin > 0;
    }
  }
  EXPECT_GT(inside, 10000);
}

}  // namespace
}  // namespace etendue
