// Sampling lights: directions lead to them, and densities are those that `pdf_triangle` says.
#include "light/light_table.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "support/moving_lights.h"

namespace etendue {
namespace {

AreaLightTriangle triangle(const Vec3& p0, const Vec3& p1, const Vec3& p2, float radiance, bool double_sided) {
  AreaLightTriangle t;
  t.radiance = Rgb(radiance), t.double_sided = double_sided;
  t.place({p0, p1, p2, 1});
  return t;
}

struct Queries {
  static constexpr size_t kCount = 150;  // more than one batch, no whole number of registers
  Vec3Lanes<160> from;
  alignas(64) std::array<float, 160> choice{}, u0{}, u1{};

  explicit Queries(const Vec3& around) {
    std::mt19937 engine(8);
    std::uniform_real_distribution<float> uniform(0, 0.99999f);
    for (size_t i = 0; i < from.x.size(); ++i) {
      from.set(i, around + Vec3(uniform(engine), uniform(engine), uniform(engine)));
      choice[i] = uniform(engine), u0[i] = uniform(engine), u1[i] = uniform(engine);
    }
  }

  std::vector<LightSample> sample(const LightTable& table, LightStrategy strategy = LightStrategy::one) {
    std::vector<LightSample> samples(kCount);
    table.sample({from, choice.data(), u0.data(), u1.data(), kCount}, samples.data(), strategy);
    return samples;
  }
};

Bounds bounds() {
  Bounds b;
  b.extend(Vec3(-5)), b.extend(Vec3(5));
  return b;
}

// Both face down, towards the receivers.
std::vector<AreaLightTriangle> ceiling() {
  return {triangle({0, 3, 0}, {1, 3, 0}, {0, 3, 1}, 1, false), triangle({2, 4, 0}, {3, 4, 0}, {2, 4, 2}, 5, true)};
}

TEST(LightTable, SamplesPointsOnItsTrianglesWithTheDensityItStates) {
  const LightTable table(ceiling(), {}, Environment{}, bounds());
  Queries queries(Vec3(0));
  int of_each[2] = {0, 0};
  const auto samples = queries.sample(table);
  for (size_t i = 0; i < samples.size(); ++i) {
    const LightSample& s = samples[i];
    ASSERT_GT(s.pdf, 0);
    ASSERT_EQ(s.kind, LightKind::triangle);
    ++of_each[s.light];
    const Vec3 point = queries.from[i] + s.wi * s.distance;
    const AreaLightTriangle& t = table.triangles()[s.light];
    const Vec3 expected = t.p0 + s.barycentric.x * t.e1 + s.barycentric.y * t.e2;
    EXPECT_LT(glm::length(point - expected), 1e-5f);
    EXPECT_NEAR(s.pdf / table.pdf_triangle(s.light, queries.from[i], expected, 0, LightStrategy::one), 1, 1e-4f);
  }
  EXPECT_GT(of_each[0], 0);
  EXPECT_GT(of_each[1], of_each[0]) << "the brighter one is chosen more often";
}

TEST(LightTable, SendsNothingFromTheBackOfASingleSidedTriangle) {
  const LightTable table(ceiling(), {}, Environment{}, bounds());
  Queries queries(Vec3(0, 4, 0));  // above both
  for (const LightSample& s : queries.sample(table)) EXPECT_EQ(s.pdf > 0, s.light == 1);
}

TEST(LightTable, ChoosesAmongLightsOfEveryKind) {
  PlacedLight lamp;
  lamp.light.type = LightType::point;
  lamp.light.color = Rgb(1), lamp.light.intensity = 5;
  lamp.place.position = Vec3(0.5f, 2, 0.5f);
  Environment sky;
  sky.tint = Rgb(0.01f);
  const LightTable table(ceiling(), {lamp}, sky, bounds());
  Queries queries(Vec3(0));
  int of_kind[3] = {0, 0, 0};
  const auto samples = queries.sample(table);
  for (size_t i = 0; i < samples.size(); ++i) {
    const LightSample& s = samples[i];
    ++of_kind[static_cast<size_t>(s.kind)];
    EXPECT_EQ(s.delta, s.kind == LightKind::placed);
    EXPECT_FALSE(s.textured);
    if (s.kind == LightKind::placed) {
      EXPECT_LT(glm::length(queries.from[i] + s.wi * s.distance - lamp.place.position), 1e-5f);
    }
  }
  for (const int n : of_kind) EXPECT_GT(n, 0);
}

TEST(LightTable, SourcesAreInstancesLampsAndTheSky) {
  auto triangles = ceiling();
  triangles.push_back(triangle({0, 3, 1}, {1, 3, 0}, {1, 3, 1}, 1, false));
  triangles[1].instance = 1, triangles[2].instance = 2;
  triangles.push_back(triangle({1, 3, 0}, {2, 3, 0}, {2, 3, 1}, 1, false));
  triangles[3].instance = 2;
  triangles.push_back(triangle({1, 3, 0}, {2, 3, 0}, {2, 3, 1}, 0, false));
  triangles[4].instance = 3;  // black: no source
  PlacedLight lamp;
  lamp.light.type = LightType::point;
  lamp.place.position = Vec3(0.5f, 2, 0.5f);
  Environment sky;
  sky.tint = Rgb(0.01f);
  const LightTable table(triangles, {lamp}, sky, bounds());
  ASSERT_EQ(table.sources(), 5U);
  Queries queries(Vec3(0));
  std::vector<LightSample> samples(Queries::kCount);
  const uint32_t first[] = {0, 1, 2, 5, 6}, last[] = {0, 1, 3, 5, 6};
  for (size_t source = 0; source < 5; ++source) {
    table.sample_source(source,
                        {queries.from, queries.choice.data(), queries.u0.data(), queries.u1.data(), Queries::kCount},
                        samples.data());
    std::set<uint32_t> met;
    for (size_t i = 0; i < samples.size(); ++i) {
      const LightSample& s = samples[i];
      met.insert(s.light);
      if (s.kind == LightKind::triangle) {
        const Vec3 point = queries.from[i] + s.wi * s.distance;
        const float expected = table.pdf_triangle(s.light, queries.from[i], point, 0, LightStrategy::every);
        EXPECT_NEAR(s.pdf / expected, 1, 1e-3f);
      } else if (s.kind == LightKind::environment) {
        EXPECT_NEAR(s.pdf, table.pdf_environment(s.wi, LightStrategy::every), 1e-5f);
      } else {
        EXPECT_EQ(s.pdf, 1);
      }
    }
    std::set<uint32_t> expected;
    for (uint32_t light = first[source]; light <= last[source]; ++light) expected.insert(light);
    EXPECT_EQ(met, expected);
  }
}

TEST(LightTable, WithoutLightsHasNoSamples) {
  Environment dark;
  dark.tint = Rgb(0);
  const LightTable table({}, {}, dark, bounds());
  Queries queries(Vec3(0));
  for (const LightSample& s : queries.sample(table)) EXPECT_EQ(s.pdf, 0);
}

// A triangle that turns and goes up, and a lamp that goes along: found where they are at the time that is asked for.
TEST(LightTable, SamplesMovingLightsWhereTheyAre) {
  Mat4 end(1);
  end[0] = Vec4(0.8f, 0.6f, 0, 0), end[1] = Vec4(-0.6f, 0.8f, 0, 0), end[3] = Vec4(0, 2, 0, 1);
  const test::MovingLights moving(end);
  const LightTable table = moving.table(bounds());

  Queries queries(Vec3(0));
  std::array<float, 160> times{};
  for (size_t i = 0; i < times.size(); ++i) times[i] = static_cast<float>(i) / 160;
  std::vector<LightSample> samples(Queries::kCount);
  table.sample(
      {queries.from, queries.choice.data(), queries.u0.data(), queries.u1.data(), samples.size(), times.data()},
      samples.data(), LightStrategy::one);
  int of_each[2] = {0, 0};
  for (size_t i = 0; i < samples.size(); ++i) {
    const LightSample& s = samples[i];
    const Vec3 point = queries.from[i] + s.wi * s.distance;
    ++of_each[s.light];
    if (s.kind == LightKind::placed) {
      EXPECT_LT(glm::distance(point, Vec3(moving.motion->matrix_at(times[i])[3])), 1e-4f);
      continue;
    }
    const Facet f = moving.motion->facet_at(*moving.mesh, moving.mesh->triangles[0], times[i]);
    const Vec3 expected = f.p0 + s.barycentric.x * (f.p1 - f.p0) + s.barycentric.y * (f.p2 - f.p0);
    EXPECT_LT(glm::distance(point, expected), 1e-4f);
    if (s.pdf == 0) continue;
    EXPECT_NEAR(table.pdf_triangle(s.light, queries.from[i], point, times[i], LightStrategy::one), s.pdf,
                2e-3f * s.pdf);
  }
  EXPECT_GT(of_each[0], 10);
  EXPECT_GT(of_each[1], 10);
}

}  // namespace
}  // namespace etendue
