// Selection of lights from a light table: by power, by the light tree, and automatically.
#include <gtest/gtest.h>

#include "support/moving_lights.h"
#include "unit/light/light_queries.h"

namespace etendue::light_selection_test {
namespace {

using test::RandomNumbers;
using test::Receivers;

AreaLightTriangle panel(const Vec3& at, float size, bool double_sided, float radiance) {
  return test::triangle(at, at + Vec3(size, 0, 0), at + Vec3(0, 0, size), radiance, double_sided);
}

// Panels above the receivers, with points and spots around them. `infinite` adds a directional light and an
// environment.
LightTable mixed_table(bool infinite, size_t panels = 40, size_t points = 10, uint32_t seed = 13) {
  RandomNumbers random(seed);
  std::vector<AreaLightTriangle> triangles;
  for (size_t i = 0; i < panels; ++i)
    triangles.push_back(panel(random.in_cube(2) + Vec3(0, 3, 0), 0.2f, i % 2 == 0, 0.5f + random()));
  std::vector<PlacedLight> placed;
  for (size_t i = 0; i < points; ++i) {
    LightEmitter emitter = PointLight::Emitter{{.color = Rgb(1), .intensity = 0.1f}};
    if (i % 2 != 0) {
      SpotLight spot;
      spot.intensity.value = 0.1f;
      emitter = spot.emitter(Rgb(1));
    }
    const Vec3 position = random.in_cube(2);
    placed.push_back(test::placed(emitter, position, random.direction()));
  }
  if (infinite) placed.push_back(test::placed(DirectionalLight::Emitter(), Vec3(0)));
  return {std::move(triangles), std::move(placed), test::constant_environment(infinite ? 0.3f : 0),
          test::bounds(Vec3(-3), Vec3(3, 6, 3))};
}

TEST(LightSelection, TreeSamplesHaveTheStatedDensities) {
  for (const bool infinite : {false, true}) {
    const LightTable table = mixed_table(infinite);
    Receivers receivers;
    RandomNumbers random(14);
    receivers.draw(random, Vec3(0), 2);
    std::array<int, 3> of_kind{};
    std::vector<PackedNormal> normals;
    for (size_t i = 0; i < Receivers::kCapacity; ++i)
      normals.push_back(i % 3 == 0 ? PackedNormal() : PackedNormal(random.direction()));
    LightQueries queries = receivers.queries();
    queries.normals = normals.data();
    std::vector<LightSample> samples(Receivers::kCount);
    table.sample(queries, samples.data(), LightStrategy::tree);
    for (size_t i = 0; i < samples.size(); ++i) {
      const LightSample& s = samples[i];
      if (s.pdf == 0) continue;
      ++of_kind[static_cast<size_t>(s.kind)];
      const LightReceiver from = queries.receiver(i);
      const Vec3 point = from.position + s.wi * s.distance;
      const float pdf = s.kind == LightKind::triangle ? table.pdf_triangle(s.light, from, point, 0, LightStrategy::tree)
                        : s.kind == LightKind::environment
                            ? table.pdf_environment(from.position, s.wi, LightStrategy::tree)
                            : table.probability(s.light, from, LightStrategy::tree);
      EXPECT_NEAR(s.pdf / pdf, 1, 2e-3f);
    }
    EXPECT_GT(of_kind[0], 100);
    EXPECT_GT(of_kind[1], 50);
    EXPECT_EQ(of_kind[2] > 50, infinite);
  }
}

// The sum is at most one, because a receiver may be outside the cones of the spots.
TEST(LightSelection, ProbabilitiesSumToOneWithInfiniteLights) {
  const LightTable table = mixed_table(true, 0, 9);
  RandomNumbers random(15);
  for (int k = 0; k < 20; ++k) {
    const Vec3 from = random.in_cube(2);
    double sum = 0;
    for (uint32_t light = 0; light < table.size(); ++light)
      sum += static_cast<double>(table.probability(light, from, LightStrategy::tree));
    EXPECT_LE(sum, 1 + 1e-5);
    EXPECT_GT(sum, 0.7);
  }
}

// Both strategies estimate the same mean of radiance over density, and the tree has less variance. z-test with 0.5 %
// false alarms per table.
TEST(LightSelection, TreeAndPowerEstimateTheSameLight) {
  for (const bool infinite : {false, true}) {
    const LightTable table = mixed_table(infinite);
    constexpr int kRounds = 400;
    std::array<double, 2> mean{};
    std::array<double, 2> variance{};
    for (const LightStrategy strategy : {LightStrategy::one, LightStrategy::tree}) {
      RandomNumbers random(16 + static_cast<uint32_t>(strategy));
      double sum = 0;
      double squares = 0;
      Receivers receivers;
      for (int round = 0; round < kRounds; ++round) {
        receivers.draw(random, Vec3(0.3f, -1, 0.2f));
        for (const LightSample& s : receivers.sample(table, strategy)) {
          const double value = s.pdf > 0 ? static_cast<double>(s.radiance.r / s.pdf) : 0;
          sum += value;
          squares += value * value;
        }
      }
      const double n = static_cast<double>(kRounds) * Receivers::kCount;
      const auto k = static_cast<size_t>(strategy != LightStrategy::one);
      mean[k] = sum / n;
      variance[k] = (squares / n - sqr(mean[k])) / n;
    }
    EXPECT_LT(std::abs(mean[0] - mean[1]), 2.8 * std::sqrt(variance[0] + variance[1]));
    if (!infinite) {
      EXPECT_LT(variance[1], variance[0]);
    }
  }
}

TEST(LightSelection, AutomaticUsesTheTreeForManySeparateLights) {
  Receivers receivers;
  RandomNumbers random(14);
  receivers.draw(random, Vec3(0), 2);
  const auto same = [&](const LightTable& table, LightStrategy strategy) {
    const auto a = receivers.sample(table, LightStrategy::automatic);
    const auto b = receivers.sample(table, strategy);
    for (size_t i = 0; i < a.size(); ++i)
      if (a[i].pdf != b[i].pdf) return false;
    return true;
  };
  const LightTable few = mixed_table(false, 2, 1);
  EXPECT_TRUE(same(few, LightStrategy::one));
  EXPECT_FALSE(same(few, LightStrategy::tree));
  EXPECT_TRUE(same(mixed_table(false), LightStrategy::tree));
  // Neighbouring triangles are one large light.
  std::vector<AreaLightTriangle> large;
  for (int i = 0; i < 36; ++i) large.push_back(panel(0.2f * Vec3(i % 6, 0, i / 6) + Vec3(0, 3, 0), 0.2f, false, 1));
  const LightTable one(std::move(large), {}, Environment{}, test::bounds(Vec3(-3), Vec3(3, 6, 3)));
  EXPECT_TRUE(same(one, LightStrategy::one));
  EXPECT_FALSE(same(one, LightStrategy::tree));
}

// A panel that rises and rotates, and a point light with the same motion: the tree includes all their positions.
TEST(LightSelection, TreeBoundsMovingLightsOverTheShutter) {
  Mat4 end(1);
  end[0] = Vec4(0, 1, 0, 0);
  end[1] = Vec4(-1, 0, 0, 0);
  end[3] = Vec4(0, 8, 0, 1);
  const test::MovingLights moving(end);
  const LightTable table = moving.table(test::bounds(Vec3(-5), Vec3(15)));
  RandomNumbers random(17);
  for (int k = 0; k < 200; ++k) {
    const Vec3 from = random.in_cube(12);
    const float p = table.probability(0, from, LightStrategy::tree);
    const float q = table.probability(1, from, LightStrategy::tree);
    EXPECT_GT(p, 0);
    EXPECT_GT(q, 0);
    EXPECT_NEAR(p + q, 1, 1e-5f);
  }
}

}  // namespace
}  // namespace etendue::light_selection_test
