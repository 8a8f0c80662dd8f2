// Learned probabilities of groups of lights: they follow the samples, and light samples have the stated densities.
#include "light/sampling/learned_light_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/light/light_queries.h"

namespace etendue::learned_light_choice_test {
namespace {

using test::RandomNumbers;
using test::Receivers;

// A contribution without variance that BSDF samples do not find.
LightContributions::Moments certain(float c) { return {c, c * c, c * c, 0}; }

// Receivers on a line along x. Group 0 lights those with x < 0, group 1 the others, with the given amounts.
LightContributions halves(float left, float right, size_t groups = 2) {
  LightContributions contributions(groups);
  RandomNumbers random(3);
  for (size_t i = 0; i < 4000; ++i) {
    const float x = 2 * random() - 1;
    contributions.add_receiver(Vec3(x, random(), 0), static_cast<uint32_t>(i));
    const float light = x < 0 ? left : right;
    contributions.moments[i * groups + (x < 0 ? 0 : 1)] = certain(light);
  }
  return contributions;
}

// A cell has 62 receivers on average, which four samples of the whole scene are added to. These have half of the mean square
// of the cell for either group, so the probability is 0.05 + 0.9 sqrt(64) / (sqrt(64) + sqrt(2)) = 0.815.
constexpr float kOfTheLitHalf = 0.815f, kTolerance = 0.03f;

TEST(LearnedLightChoice, FollowsWhatLightsTheRegion) {
  const LearnedLightChoice learned(halves(1, 1));
  EXPECT_NEAR(learned.probability(0, Vec3(-0.8f, 0.5f, 0)), kOfTheLitHalf, kTolerance);
  EXPECT_NEAR(learned.probability(1, Vec3(0.8f, 0.5f, 0)), kOfTheLitHalf, kTolerance);
}

// A group a hundred times as bright takes few samples from receivers that it does not reach: pixels in shadow count as much.
TEST(LearnedLightChoice, BrightLightElsewhereTakesFewSamples) {
  const LearnedLightChoice learned(halves(1, 100));
  EXPECT_NEAR(learned.probability(0, Vec3(-0.8f, 0.5f, 0)), 0.79f, kTolerance);
}

// Vertices of one path, of which the second one contributes a thousandth of the light of the pixel, by group 1 only.
TEST(LearnedLightChoice, VerticesCountByTheirPartOfThePixel) {
  LightContributions contributions(2);
  for (uint32_t path = 0; path < 200; ++path) {
    contributions.moments[2 * contributions.add_receiver(Vec3(0), path)] = certain(1);
    contributions.moments[2 * contributions.add_receiver(Vec3(1, 0, 0), path) + 1] = certain(0.001f);
  }
  // Where it matters little, group 1 is preferred nevertheless; the gain over equal probabilities is that of group 0.
  const LearnedLightChoice learned(contributions);
  EXPECT_GT(learned.probability(0, Vec3(0)), 0.9f);
  EXPECT_GT(learned.probability(1, Vec3(1, 0, 0)), 0.75f);
  EXPECT_NEAR(learned.gain(std::array<float, 2>{0.5f, 0.5f}), 2 * learned.probability(0, Vec3(0)), 1e-3);
}

// Two groups that contribute 3 and 1 to every receiver: the best probabilities are 3/4 and 1/4, of nine tenths.
TEST(LearnedLightChoice, ProbabilitiesAreProportionalToContributions) {
  LightContributions contributions(2);
  for (size_t i = 0; i < 500; ++i) {
    contributions.add_receiver(Vec3(static_cast<float>(i), 0, 0), static_cast<uint32_t>(i));
    contributions.moments[2 * i] = certain(3);
    contributions.moments[2 * i + 1] = certain(1);
  }
  const LearnedLightChoice learned(contributions);
  EXPECT_NEAR(learned.probability(0, Vec3(250, 0, 0)), 0.9f * 0.75f + 0.05f, 1e-4f);
}

// Half of the receivers are lit by either group. By usual probabilities of 0.99 and 0.01, a light sample has the mean square
// 0.5 / 0.99 + 0.5 / 0.01 = 50.5, by the learned ones 1 / 0.815.
TEST(LearnedLightChoice, GainIsTheRatioOfMeanSquares) {
  const std::array<float, 2> usual{0.99f, 0.01f};
  EXPECT_NEAR(LearnedLightChoice(halves(1, 1)).gain(usual) / (50.5 * 0.815), 1, 0.1);
  // BSDF samples with ten times the density of the light samples find the light in any case.
  LightContributions found_by_bsdf = halves(1, 1);
  for (auto& m : found_by_bsdf.moments) m.by_bsdf = 10 * m.square;
  EXPECT_NEAR(LearnedLightChoice(found_by_bsdf).gain(usual), 1.03, 0.03);
  EXPECT_EQ(LearnedLightChoice(LightContributions(2)).gain(usual), 1);
}

TEST(LearnedLightChoice, EveryGroupKeepsAProbabilityEverywhere) {
  for (const LightContributions& contributions : {halves(1, 1, 5), halves(0, 0, 5), LightContributions(5)}) {
    const LearnedLightChoice learned(contributions);
    for (const Vec3& p : {Vec3(-0.5f, 0.5f, 0), Vec3(0.5f, 0, 0), Vec3(1e30f, -1e30f, 5), Vec3(NAN)}) {
      float sum = 0;
      for (size_t g = 0; g < 5; ++g) {
        EXPECT_GE(learned.probability(g, p), 0.019f);
        sum += learned.probability(g, p);
      }
      EXPECT_NEAR(sum, 1, 1e-5f);
    }
  }
}

TEST(LearnedLightChoice, ChoosesWithTheStatedProbability) {
  const LearnedLightChoice learned(halves(2, 1, 3));
  constexpr int kNumbers = 100'000;
  for (const Vec3& p : {Vec3(-0.5f, 0.5f, 0), Vec3(0.01f, 0.2f, 0)}) {
    std::array<double, 3> chosen{}, rest{};
    for (int i = 0; i < kNumbers; ++i) {
      const auto group = learned.choose(p, (static_cast<float>(i) + 0.5f) / kNumbers);
      EXPECT_EQ(group.probability, learned.probability(group.index, p));
      chosen[group.index] += 1.0 / kNumbers;
      rest[group.index] += double{group.rest};
    }
    for (size_t g = 0; g < 3; ++g) {
      EXPECT_NEAR(chosen[g], double{learned.probability(g, p)}, 1e-4);
      EXPECT_NEAR(rest[g] / (chosen[g] * kNumbers), 0.5, 0.01);
    }
    EXPECT_EQ(learned.choose(p, kOneMinusEpsilon).index, 2U);
  }
}

// Two lights of two triangles each, a point light, a directional light and the sky: five sources.
LightTable mixed_lights(const Environment& sky, size_t small_lights = 0) {
  std::vector<AreaLightTriangle> triangles;
  const auto add = [&](const Vec3& corner, float size, float radiance) {
    const Vec3 x(size, 0, 0), z(0, 0, size);
    const uint32_t instance = triangles.empty() ? 0 : triangles.back().instance + 1;
    for (const auto& t : {test::triangle(corner, corner + x, corner + z, radiance, true),
                          test::triangle(corner + x + z, corner + z, corner + x, 2 * radiance, true)}) {
      triangles.push_back(t);
      triangles.back().instance = instance;
    }
  };
  add({-1, 3, 0}, 1, 1);
  add({2, 2.5f, 0}, 0.5f, 8);
  for (size_t i = 0; i < small_lights; ++i) add({static_cast<float>(i) - 4, 4, -3}, 0.1f, 20);
  return {triangles,
          {test::placed(PointLight::Emitter{{.color = Rgb(1), .intensity = 5}}, {0.5f, 2, 0.5f}),
           test::placed(DirectionalLight::Emitter(), Vec3(0), {0, -1, 0})},
          sky,
          test::bounds(Vec3(-5), Vec3(5))};
}

LearnedLightChoice random_choice(size_t groups) {
  LightContributions contributions(groups);
  RandomNumbers random(11);
  for (uint32_t i = 0; i < 3000; ++i) contributions.add_receiver(random.in_cube(1), i);
  for (auto& m : contributions.moments) m = certain(random());
  return LearnedLightChoice(contributions);
}

// With few lights each source is a group. Many small lights are one, chosen by the tree.
TEST(LearnedLightChoice, GroupsAreSourcesOrTheTree) {
  EXPECT_EQ(mixed_lights(test::constant_environment(0.01f)).group_count(LightStrategy::automatic), 5U);
  EXPECT_EQ(mixed_lights(test::constant_environment(0)).group_count(LightStrategy::automatic), 4U);
  EXPECT_EQ(mixed_lights(test::constant_environment(0.01f), 6).group_count(LightStrategy::automatic), 3U);
  // Compensated samples leave out a uniform environment.
  const auto compensated = LightSampling::compensated(LightStrategy::automatic);
  EXPECT_EQ(mixed_lights(test::constant_environment(0.01f)).group_count(compensated), 4U);
}

// Without learning, the probabilities of the groups sum to one, and are those of their lights.
TEST(LearnedLightChoice, UsualProbabilitiesAreThoseOfTheLights) {
  for (const size_t small_lights : {0, 6}) {
    const LightTable table = mixed_lights(test::constant_environment(0.01f), small_lights);
    const LightSampling sampling(LightStrategy::automatic);
    const size_t groups = table.group_count(sampling);
    float sum = 0;
    for (size_t g = 0; g < groups; ++g) sum += table.usual_probability_of_group(g, sampling);
    EXPECT_NEAR(sum, 1, 1e-5f);
    // The last two groups are the directional light and the environment.
    for (const size_t from_last : {1, 2})
      EXPECT_NEAR(table.usual_probability_of_group(groups - from_last, sampling),
                  table.probability(static_cast<uint32_t>(table.size() - from_last), Vec3(0), sampling), 1e-6f);
  }
}

// For receivers everywhere, the probabilities of all lights sum to one, samples state the probability of their light, and
// the densities of points that other techniques found are those of the samples.
TEST(LearnedLightChoice, LightSamplesHaveTheStatedDensities) {
  for (const size_t small_lights : {0, 6}) {
    const LightTable table = mixed_lights(test::constant_environment(0.01f), small_lights);
    LightSampling sampling(LightStrategy::automatic);
    const LearnedLightChoice learned = random_choice(table.group_count(sampling));
    sampling.learned = &learned;
    Receivers receivers;
    RandomNumbers random(5);
    receivers.draw(random, Vec3(0), 1.2f);
    std::vector<LightSample> samples(Receivers::kCount);
    table.sample(receivers.queries(), samples.data(), sampling);
    std::array<int, 3> of_kind{};
    for (size_t i = 0; i < samples.size(); ++i) {
      const LightSample& s = samples[i];
      const Vec3 from = receivers.from[i];
      ++of_kind[static_cast<size_t>(s.kind)];
      float sum = 0;
      for (uint32_t light = 0; light < table.size(); ++light) sum += table.probability(light, from, sampling);
      EXPECT_NEAR(sum, 1, 1e-4f);
      EXPECT_NEAR(s.choice / table.probability(s.light, from, sampling), 1, 1e-4f);
      if (s.pdf == 0) continue;
      if (s.kind == LightKind::triangle) {
        EXPECT_NEAR(s.pdf / table.pdf_triangle(s.light, from, from + s.wi * s.distance, 0, sampling), 1, 2e-3f);
      } else if (s.kind == LightKind::environment) {
        EXPECT_NEAR(s.pdf / table.pdf_environment(from, s.wi, sampling), 1, 1e-3f);
      }
    }
    for (const int n : of_kind) EXPECT_GT(n, 50);
  }
}

}  // namespace
}  // namespace etendue::learned_light_choice_test
