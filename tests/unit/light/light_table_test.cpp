// The light table: samples of every kind of light have the stated densities.
#include "light/sampling/light_table.h"

#include <gtest/gtest.h>

#include <set>

#include "support/moving_lights.h"
#include "unit/light/light_queries.h"

namespace etendue::light_table_test {
namespace {

using test::RandomNumbers;
using test::Receivers;

Bounds scene_bounds() { return test::bounds(Vec3(-5), Vec3(5)); }

// Two triangles that face down, the second brighter and two-sided.
std::vector<AreaLightTriangle> ceiling() {
  return {test::triangle({0, 3, 0}, {1, 3, 0}, {0, 3, 1}, 1, false),
          test::triangle({2, 4, 0}, {3, 4, 0}, {2, 4, 2}, 5, true)};
}

PlacedLight point_light() {
  return test::placed(PointLight::Emitter{{.color = Rgb(1), .intensity = 5}}, {0.5f, 2, 0.5f});
}

Receivers receivers_around(const Vec3& centre) {
  Receivers receivers;
  RandomNumbers random(8);
  receivers.draw(random, centre, 0.5f);
  return receivers;
}

TEST(LightTable, SamplesPointsOnTrianglesWithTheStatedDensity) {
  const LightTable table(ceiling(), {}, Environment{}, scene_bounds());
  Receivers receivers = receivers_around(Vec3(0.5f));
  int of_each[2] = {0, 0};
  const auto samples = receivers.sample(table);
  for (size_t i = 0; i < samples.size(); ++i) {
    const LightSample& s = samples[i];
    ASSERT_GT(s.pdf, 0);
    ASSERT_EQ(s.kind, LightKind::triangle);
    ++of_each[s.light];
    const Vec3 point = receivers.from[i] + s.wi * s.distance;
    const AreaLightTriangle& t = table.triangles()[s.light];
    const Vec3 expected = t.p0 + s.barycentric.x * t.e1 + s.barycentric.y * t.e2;
    EXPECT_LT(glm::length(point - expected), 1e-5f);
    EXPECT_NEAR(s.pdf / table.pdf_triangle(s.light, receivers.from[i], expected, 0, LightStrategy::one), 1, 1e-4f);
  }
  EXPECT_GT(of_each[0], 0);
  EXPECT_GT(of_each[1], of_each[0]) << "the brighter triangle is sampled more often";
}

TEST(LightTable, BackOfAOneSidedTriangleEmitsNothing) {
  const LightTable table(ceiling(), {}, Environment{}, scene_bounds());
  Receivers receivers = receivers_around(Vec3(0.5f, 4.5f, 0.5f));  // above both
  for (const LightSample& s : receivers.sample(table)) EXPECT_EQ(s.pdf > 0, s.light == 1);
}

TEST(LightTable, SamplesLightsOfEveryKind) {
  const PlacedLight point = point_light();
  const LightTable table(ceiling(), {point}, test::constant_environment(0.01f), scene_bounds());
  Receivers receivers = receivers_around(Vec3(0.5f));
  int of_kind[3] = {0, 0, 0};
  const auto samples = receivers.sample(table);
  for (size_t i = 0; i < samples.size(); ++i) {
    const LightSample& s = samples[i];
    ++of_kind[static_cast<size_t>(s.kind)];
    EXPECT_EQ(s.delta, s.kind == LightKind::placed);
    EXPECT_FALSE(s.textured);
    if (s.kind == LightKind::placed) {
      EXPECT_LT(glm::length(receivers.from[i] + s.wi * s.distance - point.place.position), 1e-5f);
    }
  }
  for (const int n : of_kind) EXPECT_GT(n, 0);
}

TEST(LightTable, SourcesAreInstancesPlacedLightsAndTheEnvironment) {
  auto triangles = ceiling();
  triangles.push_back(test::triangle({0, 3, 1}, {1, 3, 0}, {1, 3, 1}, 1, false));
  triangles.push_back(test::triangle({1, 3, 0}, {2, 3, 0}, {2, 3, 1}, 1, false));
  triangles.push_back(test::triangle({1, 3, 0}, {2, 3, 0}, {2, 3, 1}, 0, false));  // black, therefore no source
  const uint32_t instances[] = {0, 1, 2, 2, 3};
  for (size_t i = 0; i < triangles.size(); ++i) triangles[i].instance = instances[i];
  const LightTable table(triangles, {point_light()}, test::constant_environment(0.01f), scene_bounds());
  ASSERT_EQ(table.source_count(), 5U);
  Receivers receivers = receivers_around(Vec3(0.5f));
  std::vector<LightSample> samples(Receivers::kCount);
  const uint32_t first[] = {0, 1, 2, 5, 6};
  const uint32_t last[] = {0, 1, 3, 5, 6};
  for (size_t source = 0; source < 5; ++source) {
    table.sample_source(source, receivers.queries(), samples.data());
    std::set<uint32_t> sampled;
    for (size_t i = 0; i < samples.size(); ++i) {
      const LightSample& s = samples[i];
      sampled.insert(s.light);
      if (s.kind == LightKind::triangle) {
        const Vec3 point = receivers.from[i] + s.wi * s.distance;
        const float expected = table.pdf_triangle(s.light, receivers.from[i], point, 0, LightStrategy::every);
        EXPECT_NEAR(s.pdf / expected, 1, 1e-3f);
      } else if (s.kind == LightKind::environment) {
        EXPECT_NEAR(s.pdf, table.pdf_environment(receivers.from[i], s.wi, LightStrategy::every), 1e-5f);
      } else {
        EXPECT_EQ(s.pdf, 1);
      }
    }
    std::set<uint32_t> expected;
    for (uint32_t light = first[source]; light <= last[source]; ++light) expected.insert(light);
    EXPECT_EQ(sampled, expected);
  }
}

// Equiangular samples choose among lights at points, whatever the powers of the others.
TEST(LightTable, PointLightsAreChosenAmongThemselves) {
  PlacedLight first = point_light(), second = point_light();
  second.place.position = Vec3(1, 2, 3);
  const LightTable one(ceiling(), {first}, test::constant_environment(1000), scene_bounds());
  const LightTable two(ceiling(), {first, second}, test::constant_environment(1000), scene_bounds());
  ASSERT_TRUE(two.has_point_lights());
  for (const float u : {0.0f, 0.3f, 0.6f, kOneMinusEpsilon}) {
    EXPECT_EQ(one.choose_point_light(u, 0)->probability, 1);
    const auto chosen = two.choose_point_light(u, 0);
    ASSERT_TRUE(chosen);
    EXPECT_NEAR(chosen->probability, 0.5f, 1e-6f);
    EXPECT_EQ(two.point_light(chosen->light, 0)->probability, chosen->probability);
  }
  EXPECT_NE(two.choose_point_light(0, 0)->position, two.choose_point_light(kOneMinusEpsilon, 0)->position);
  EXPECT_FALSE(LightTable(ceiling(), {}, test::constant_environment(1), scene_bounds()).has_point_lights());
}

// A uniform environment is left to BSDF samples: all compensated samples go to the other lights.
TEST(LightTable, CompensatedSamplesLeaveOutAUniformEnvironment) {
  const LightTable table(ceiling(), {point_light()}, test::constant_environment(0.01f), scene_bounds());
  const LightTable without(ceiling(), {point_light()}, test::constant_environment(0), scene_bounds());
  for (const LightStrategy strategy : {LightStrategy::one, LightStrategy::tree, LightStrategy::automatic}) {
    Receivers receivers = receivers_around(Vec3(0.5f));
    const auto sampling = LightSampling::compensated(strategy);
    std::vector<LightSample> samples(Receivers::kCount);
    table.sample(receivers.queries(), samples.data(), sampling);
    for (size_t i = 0; i < samples.size(); ++i) {
      const Vec3 from = receivers.from[i];
      EXPECT_NE(samples[i].kind, LightKind::environment);
      EXPECT_FLOAT_EQ(table.probability(samples[i].light, from, sampling),
                      without.probability(samples[i].light, from, strategy));
      EXPECT_EQ(table.pdf_environment(from, samples[i].wi, sampling), 0);
      EXPECT_GT(table.pdf_environment(from, samples[i].wi, strategy), 0);
    }
  }
  EXPECT_EQ(table.source_count(LightSampling::compensated(LightStrategy::every)), table.source_count() - 1);
}

// Only the environment emits, uniformly.
TEST(LightTable, CompensatedSamplesCanBeNone) {
  const LightTable table({}, {}, test::constant_environment(1), scene_bounds());
  const auto sampling = LightSampling::compensated(LightStrategy::automatic);
  EXPECT_FALSE(table.empty());
  EXPECT_TRUE(table.empty(sampling));
  Receivers receivers = receivers_around(Vec3(0.5f));
  std::vector<LightSample> samples(Receivers::kCount);
  table.sample(receivers.queries(), samples.data(), sampling);
  for (const LightSample& s : samples) EXPECT_EQ(s.pdf, 0);
}

TEST(LightTable, HasNoSamplesWithoutLights) {
  const LightTable table({}, {}, test::constant_environment(0), scene_bounds());
  Receivers receivers = receivers_around(Vec3(0.5f));
  for (const LightSample& s : receivers.sample(table)) EXPECT_EQ(s.pdf, 0);
  EXPECT_EQ(table.sample_emission({0.5f, Vec2(0.5f), Vec2(0.5f)}).weight, 0);
}

// A triangle that rises and rotates, and a point light with the same motion.
TEST(LightTable, SamplesMovingLightsAtTheTimeOfTheQuery) {
  Mat4 end(1);
  end[0] = Vec4(0.8f, 0.6f, 0, 0);
  end[1] = Vec4(-0.6f, 0.8f, 0, 0);
  end[3] = Vec4(0, 2, 0, 1);
  const test::MovingLights moving(end);
  const LightTable table = moving.table(scene_bounds());

  Receivers receivers = receivers_around(Vec3(0.5f));
  LightQueries queries = receivers.queries();
  queries.times = receivers.times.data();
  std::vector<LightSample> samples(Receivers::kCount);
  table.sample(queries, samples.data(), LightStrategy::one);
  int of_each[2] = {0, 0};
  for (size_t i = 0; i < samples.size(); ++i) {
    const LightSample& s = samples[i];
    const float time = receivers.times[i];
    const Vec3 point = receivers.from[i] + s.wi * s.distance;
    ++of_each[s.light];
    if (s.kind == LightKind::placed) {
      EXPECT_LT(glm::distance(point, Vec3(moving.motion->matrix_at(time)[3])), 1e-4f);
      continue;
    }
    const Facet f = moving.motion->facet_at(*moving.mesh, moving.mesh->triangles[0], time);
    const Vec3 expected = f.p0 + s.barycentric.x * (f.p1 - f.p0) + s.barycentric.y * (f.p2 - f.p0);
    EXPECT_LT(glm::distance(point, expected), 1e-4f);
    if (s.pdf == 0) continue;
    EXPECT_NEAR(table.pdf_triangle(s.light, receivers.from[i], point, time, LightStrategy::one), s.pdf, 2e-3f * s.pdf);
  }
  EXPECT_GT(of_each[0], 10);
  EXPECT_GT(of_each[1], 10);
}

}  // namespace
}  // namespace etendue::light_table_test
