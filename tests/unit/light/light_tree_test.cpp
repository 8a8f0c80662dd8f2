// The light tree: the probabilities of its selections.
#include "light/sampling/light_tree.h"

#include <gtest/gtest.h>

#include "equations/pearson_test.h"
#include "unit/light/light_queries.h"

namespace etendue::light_tree_test {
namespace {

using test::RandomNumbers;

LightBounds point_at(const Vec3& position, float intensity = 1) {
  LightBounds b;
  b.box.extend(position);
  b.intensity = intensity;
  return b;
}

// Point lights, one-sided and two-sided panels, spots, and points of short range, in a cube.
std::vector<LightBounds> mixed_lights(size_t count, float scale, uint32_t seed) {
  RandomNumbers random(seed);
  std::vector<LightBounds> lights;
  for (size_t i = 0; i < count; ++i) {
    LightBounds b = point_at(random.in_cube(scale), 0.1f + random());
    switch (i % 5) {
      case 0:
        break;
      case 1:
      case 2:
        b.box.extend(b.box.min + random.in_cube(0.05f * scale));
        b.axis = random.direction();
        b.normals = 0;
        b.two_sided = i % 5 == 2;
        break;
      case 3:
        b.axis = random.direction();
        b.normals = 0;
        b.emission = 0.5f;
        break;
      default:
        b.range = 0.5f * scale;
    }
    lights.push_back(b);
  }
  return lights;
}

double sum_of_probabilities(const LightTree& tree, size_t lights, const Vec3& from) {
  double sum = 0;
  for (uint32_t i = 0; i < lights; ++i) sum += static_cast<double>(tree.probability(i, from));
  return sum;
}

TEST(LightTree, ProbabilitiesSumToOneIfEveryLightReachesTheReceiver) {
  RandomNumbers random(3);
  for (const size_t count : {1U, 2U, 8U, 9U, 100U, 1000U}) {
    std::vector<LightBounds> lights;
    for (size_t i = 0; i < count; ++i) lights.push_back(point_at(random.in_cube(1), random() + 0.01f));
    const LightTree tree(lights);
    for (int k = 0; k < 20; ++k) EXPECT_NEAR(sum_of_probabilities(tree, count, random.in_cube(1.5f)), 1, 1e-5) << count;
  }
}

// Chi-square test of the selections against `probability`, with 1 % false alarms over all receivers. Lights that do not
// reach a receiver leave a fraction of selections without a light, which is a cell of its own.
TEST(LightTree, SelectsWithTheStatedProbabilities) {
  constexpr size_t kLights = 60;
  constexpr int kSamples = 60000;
  constexpr int kReceivers = 8;
  RandomNumbers random(4);
  const LightTree tree(mixed_lights(kLights, 1, 5));
  for (int receiver = 0; receiver < kReceivers; ++receiver) {
    const Vec3 from = random.in_cube(1.2f);
    std::vector<int> chosen(kLights + 1, 0);
    for (int i = 0; i < kSamples; ++i) {
      const auto choice = tree.choose(from, random());
      if (choice.probability == 0) {
        ++chosen[kLights];
        continue;
      }
      ++chosen[choice.index];
      ASSERT_NEAR(choice.probability / tree.probability(choice.index, from), 1, 1e-5f);
    }
    // Cells with an expectation below 5 are pooled.
    double statistic = 0;
    double rest = 1;
    double rare = 0;
    int cells = 0;
    int rare_count = 0;
    const auto add_cell = [&](int observed, double p) {
      const double expected = p * kSamples;
      statistic += sqr(observed - expected) / expected;
      ++cells;
    };
    for (uint32_t i = 0; i <= kLights; ++i) {
      const double p = i < kLights ? static_cast<double>(tree.probability(i, from)) : std::max(rest, 0.0);
      rest -= p;
      if (p * kSamples < 5) {
        rare += p;
        rare_count += chosen[i];
      } else {
        add_cell(chosen[i], p);
      }
    }
    if (rare * kSamples >= 5)
      add_cell(rare_count, rare);
    else
      EXPECT_LT(rare_count, 20);
    EXPECT_GT(equations::chi_square_survival(statistic, cells - 1), 0.01 / kReceivers) << "receiver " << receiver;
  }
}

// Unbiasedness: every light that reaches a receiver has a positive probability there.
TEST(LightTree, IncludesEveryLightThatReachesTheReceiver) {
  constexpr size_t kLights = 300;
  const auto lights = mixed_lights(kLights, 1, 6);
  const LightTree tree(lights);
  RandomNumbers random(7);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 from = random.in_cube(1.5f);
    const auto i = static_cast<uint32_t>(random() * kLights);
    const LightBounds& b = lights[i];
    const Vec3 part(random(), random(), random());
    const Vec3 point = b.box.min + part * (b.box.max - b.box.min);
    const Vec3 to = from - point;
    const float distance = glm::length(to);
    float cosine = glm::dot(to, b.axis) / distance;
    if (b.two_sided) cosine = std::abs(cosine);
    const bool reaches = distance < b.range && (b.normals >= kPi || cosine > std::cos(b.emission));
    if (reaches) {
      EXPECT_GT(tree.probability(i, from), 0) << i << " from " << from.x << ' ' << from.y << ' ' << from.z;
    }
  }
}

TEST(LightTree, PrefersNearbyLightsThatFaceTheReceiver) {
  std::vector<LightBounds> lights{point_at({0, 1, 0}), point_at({10, 1, 0})};
  EXPECT_NEAR(LightTree(lights).probability(1, Vec3(0)), 1.0 / 102, 1e-5);
  lights[0].axis = Vec3(0, 1, 0);
  lights[0].normals = 0;
  EXPECT_EQ(LightTree(lights).probability(0, Vec3(0)), 0) << "the receiver is behind it";
  lights[0].two_sided = true;
  EXPECT_NEAR(LightTree(lights).probability(0, Vec3(0)), 101.0 / 102, 1e-5);
}

// The cosine at the receiver counts, but no light that reaches it is excluded.
TEST(LightTree, PrefersLightsInFrontOfTheReceiver) {
  const std::vector<LightBounds> lights{point_at({0, 1, 0}), point_at({0, -1, 0}), point_at({1, 0, 0})};
  const LightTree tree(lights);
  const LightReceiver up(Vec3(0), PackedNormal({0, 1, 0}));
  EXPECT_NEAR(tree.probability(0, up), 1 / 1.04, 1e-3);
  EXPECT_NEAR(tree.probability(1, up), 0.02 / 1.04, 1e-3);
  EXPECT_NEAR(tree.probability(0, Vec3(0)), 1.0 / 3, 1e-5);
  RandomNumbers random(21);
  const LightTree many(mixed_lights(200, 1, 6));
  for (int k = 0; k < 50; ++k) {
    const LightReceiver receiver(random.in_cube(1.5f), PackedNormal(random.direction()));
    double sum = 0;
    for (uint32_t i = 0; i < 200; ++i) {
      const float p = many.probability(i, receiver);
      EXPECT_EQ(p > 0, many.probability(i, receiver.position) > 0) << i;
      sum += static_cast<double>(p);
    }
    EXPECT_LT(sum, 1 + 1e-5);
    const auto choice = many.choose(receiver, random());
    if (choice.probability > 0) {
      EXPECT_NEAR(choice.probability / many.probability(choice.index, receiver), 1, 1e-5f);
    }
  }
}

TEST(PackedNormal, IsAccurate) {
  EXPECT_FALSE(PackedNormal());
  EXPECT_EQ(PackedNormal().unpacked(), Vec3(0));
  RandomNumbers random(22);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 n = random.direction();
    const PackedNormal packed(n);
    EXPECT_TRUE(packed);
    EXPECT_LT(glm::distance(packed.unpacked(), n), 2e-3f);
  }
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)})
    EXPECT_EQ(PackedNormal(axis).unpacked(), axis);
}

TEST(LightTree, NeverSelectsLightsWithoutPower) {
  std::vector<LightBounds> lights{point_at({0, 1, 0}, 0), point_at({1, 1, 0}), point_at({2, 1, 0}, 0)};
  const LightTree tree(lights);
  for (const float u : {0.0f, 0.3f, kOneMinusEpsilon}) EXPECT_EQ(tree.choose(Vec3(0), u).index, 1U);
  EXPECT_EQ(tree.probability(0, Vec3(0)), 0);
  EXPECT_EQ(tree.probability(1, Vec3(0)), 1);
  EXPECT_TRUE(LightTree(std::vector{lights[0], lights[2]}).empty());
  EXPECT_TRUE(LightTree(std::vector<LightBounds>{}).empty());
}

// Lights at one position are selected in proportion to their intensity, and the depth of the tree is normal.
TEST(LightTree, SupportsCoincidentLights) {
  const std::vector<LightBounds> three{point_at(Vec3(1), 1), point_at(Vec3(1), 2), point_at(Vec3(1), 5)};
  for (const Vec3& from : {Vec3(0), Vec3(1)}) {  // distant, and at the same position
    EXPECT_NEAR(LightTree(three).probability(2, from), 5.0 / 8, 1e-6);
  }

  constexpr size_t kMany = 100'000;
  const LightTree tree(std::vector<LightBounds>(kMany, point_at(Vec3(1))));
  RandomNumbers random(8);
  for (int k = 0; k < 1000; ++k) {
    const auto choice = tree.choose(Vec3(0), random());
    EXPECT_NEAR(choice.probability * kMany, 1, 1e-3f);
    EXPECT_NEAR(tree.probability(choice.index, Vec3(0)) * kMany, 1, 1e-3f);
  }
}

TEST(LightTree, SupportsReceiversOnLights) {
  RandomNumbers random(9);
  std::vector<LightBounds> lights;
  for (int i = 0; i < 50; ++i) lights.push_back(point_at(random.in_cube(1)));
  const LightTree tree(lights);
  for (uint32_t i = 0; i < lights.size(); ++i) {
    const Vec3 from = lights[i].box.min;
    EXPECT_GT(tree.probability(i, from), 5.0f / 50);
    EXPECT_NEAR(sum_of_probabilities(tree, lights.size(), from), 1, 1e-5);
  }
}

TEST(LightTree, IsScaleInvariant) {
  const LightTree metres(mixed_lights(200, 1, 11));
  for (const float scale : {1e-6f, 1e-3f, 1e3f, 1e6f}) {
    const LightTree scaled(mixed_lights(200, scale, 11));
    RandomNumbers random(12);
    for (int k = 0; k < 200; ++k) {
      const Vec3 from = random.in_cube(1.5f);
      const auto light = static_cast<uint32_t>(random() * 200);
      const float p = metres.probability(light, from), q = scaled.probability(light, from * scale);
      EXPECT_NEAR(p, q, 1e-3f * p + 1e-5f) << scale;
    }
  }
}

}  // namespace
}  // namespace etendue::light_tree_test
