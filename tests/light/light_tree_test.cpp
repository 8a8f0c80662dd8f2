// The tree over lights: what it chooses, how often, and what it says about that.
#include "light/light_tree.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "support/chi_square.h"
#include "support/moving_lights.h"

namespace etendue {
namespace {

class Numbers {
 public:
  explicit Numbers(uint32_t seed) : engine_(seed) {}
  float operator()() { return std::min(uniform_(engine_), kOneMinusEpsilon); }
  Vec3 in_cube(float half) { return half * (2.0f * Vec3((*this)(), (*this)(), (*this)()) - 1.0f); }
  Vec3 direction() { return square_to_sphere({(*this)(), (*this)()}); }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<float> uniform_{0, 1};
};

LightBounds lamp_at(const Vec3& position, float intensity = 1) {
  LightBounds b;
  b.box.extend(position), b.intensity = intensity;
  return b;
}

// Lamps, panels of one side and of two, spots and lamps of short range, within a cube.
std::vector<LightBounds> mixture(size_t count, float scale, uint32_t seed) {
  Numbers random(seed);
  std::vector<LightBounds> lights;
  for (size_t i = 0; i < count; ++i) {
    LightBounds b = lamp_at(random.in_cube(scale), 0.1f + random());
    switch (i % 5) {
      case 0:
        break;
      case 1:
      case 2:
        b.box.extend(b.box.min + random.in_cube(0.05f * scale));
        b.axis = random.direction(), b.normals = 0, b.two_sided = i % 5 == 2;
        break;
      case 3:
        b.axis = random.direction(), b.normals = 0, b.emission = 0.5f;
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

TEST(LightTree, ProbabilitiesOfLightsThatSendEverywhereSumToOne) {
  Numbers random(3);
  for (const size_t count : {1U, 2U, 8U, 9U, 100U, 1000U}) {
    std::vector<LightBounds> lights;
    for (size_t i = 0; i < count; ++i) lights.push_back(lamp_at(random.in_cube(1), random() + 0.01f));
    const LightTree tree(lights);
    for (int k = 0; k < 20; ++k) EXPECT_NEAR(sum_of_probabilities(tree, count, random.in_cube(1.5f)), 1, 1e-5) << count;
  }
}

// Where some reach only a part of the places, what is missing is what `choose` finds nothing for; and what it finds has
// the probability that it says, and that asking for the light says.
TEST(LightTree, ChoosesAsOftenAsItSays) {
  constexpr size_t kLights = 60;
  constexpr int kSamples = 60000, kPlaces = 8;
  Numbers random(4);
  const LightTree tree(mixture(kLights, 1, 5));
  for (int place = 0; place < kPlaces; ++place) {
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
    // Cells that are met too seldom count as one.
    double statistic = 0, rest = 1, rare = 0;
    int cells = 0, seen_rare = 0;
    const auto count = [&](int seen, double p) {
      const double expected = p * kSamples;
      statistic += sqr(seen - expected) / expected, ++cells;
    };
    for (uint32_t i = 0; i <= kLights; ++i) {
      const double p = i < kLights ? static_cast<double>(tree.probability(i, from)) : std::max(rest, 0.0);
      rest -= p;
      if (p * kSamples < 5)
        rare += p, seen_rare += chosen[i];
      else
        count(chosen[i], p);
    }
    if (rare * kSamples >= 5)
      count(seen_rare, rare);
    else
      EXPECT_LT(seen_rare, 20);
    EXPECT_GT(test::chi_square_tail(statistic, cells - 1), 0.01 / kPlaces) << "from place " << place;
  }
}

// A light that can send something to a place is chosen there with some probability.
TEST(LightTree, LeavesOutNoLightThatReachesAPlace) {
  constexpr size_t kLights = 300;
  const auto lights = mixture(kLights, 1, 6);
  const LightTree tree(lights);
  Numbers random(7);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 from = random.in_cube(1.5f);
    const auto i = static_cast<uint32_t>(random() * kLights);
    const LightBounds& b = lights[i];
    const Vec3 part(random(), random(), random());
    const Vec3 point = b.box.min + part * (b.box.max - b.box.min), to = from - point;
    const float distance = glm::length(to);
    float cosine = glm::dot(to, b.axis) / distance;
    if (b.two_sided) cosine = std::abs(cosine);
    const bool reaches = distance < b.range && (b.normals >= kPi || cosine > std::cos(b.emission));
    if (reaches) {
      EXPECT_GT(tree.probability(i, from), 0) << i << " from " << from.x << ' ' << from.y << ' ' << from.z;
    }
  }
}

TEST(LightTree, PrefersWhatIsNearAndFacesThePlace) {
  std::vector<LightBounds> lights{lamp_at({0, 1, 0}), lamp_at({10, 1, 0})};
  EXPECT_NEAR(LightTree(lights).probability(1, Vec3(0)), 1.0 / 102, 1e-5);
  lights[0].axis = Vec3(0, 1, 0), lights[0].normals = 0;
  EXPECT_EQ(LightTree(lights).probability(0, Vec3(0)), 0) << "it shows its back";
  lights[0].two_sided = true;
  EXPECT_NEAR(LightTree(lights).probability(0, Vec3(0)), 101.0 / 102, 1e-5);
}

TEST(LightTree, NeverChoosesLightsWithoutPower) {
  std::vector<LightBounds> lights{lamp_at({0, 1, 0}, 0), lamp_at({1, 1, 0}), lamp_at({2, 1, 0}, 0)};
  const LightTree tree(lights);
  for (const float u : {0.0f, 0.3f, kOneMinusEpsilon}) EXPECT_EQ(tree.choose(Vec3(0), u).index, 1U);
  EXPECT_EQ(tree.probability(0, Vec3(0)), 0);
  EXPECT_EQ(tree.probability(1, Vec3(0)), 1);
  EXPECT_TRUE(LightTree(std::vector{lights[0], lights[2]}).empty());
  EXPECT_TRUE(LightTree(std::vector<LightBounds>{}).empty());
}

// All at one place: nothing tells them apart but how strong they are, and the way down is short all the same.
TEST(LightTree, TakesLightsThatCoincide) {
  const std::vector<LightBounds> three{lamp_at(Vec3(1), 1), lamp_at(Vec3(1), 2), lamp_at(Vec3(1), 5)};
  for (const Vec3& from : {Vec3(0), Vec3(1)}) {  // afar, and at the very place
    EXPECT_NEAR(LightTree(three).probability(2, from), 5.0 / 8, 1e-6);
  }

  constexpr size_t kMany = 100'000;
  const LightTree tree(std::vector<LightBounds>(kMany, lamp_at(Vec3(1))));
  Numbers random(8);
  for (int k = 0; k < 1000; ++k) {
    const auto choice = tree.choose(Vec3(0), random());
    EXPECT_NEAR(choice.probability * kMany, 1, 1e-3f);
    EXPECT_NEAR(tree.probability(choice.index, Vec3(0)) * kMany, 1, 1e-3f);
  }
}

TEST(LightTree, TakesPlacesOnLights) {
  Numbers random(9);
  std::vector<LightBounds> lights;
  for (int i = 0; i < 50; ++i) lights.push_back(lamp_at(random.in_cube(1)));
  const LightTree tree(lights);
  for (uint32_t i = 0; i < lights.size(); ++i) {
    const Vec3 from = lights[i].box.min;
    EXPECT_GT(tree.probability(i, from), 5.0f / 50);
    EXPECT_NEAR(sum_of_probabilities(tree, lights.size(), from), 1, 1e-5);
  }
}

TEST(LightTree, IsTheSameAtEveryScale) {
  const LightTree metres(mixture(200, 1, 11));
  for (const float scale : {1e-6f, 1e-3f, 1e3f, 1e6f}) {
    const LightTree scaled(mixture(200, scale, 11));
    Numbers random(12);
    for (int k = 0; k < 200; ++k) {
      const Vec3 from = random.in_cube(1.5f);
      const auto light = static_cast<uint32_t>(random() * 200);
      const float p = metres.probability(light, from), q = scaled.probability(light, from * scale);
      EXPECT_NEAR(p, q, 1e-3f * p + 1e-5f) << scale;
    }
  }
}

// ---- In the table.

AreaLightTriangle panel(const Vec3& at, float size, bool double_sided, float radiance) {
  AreaLightTriangle t;
  t.radiance = Rgb(radiance), t.double_sided = double_sided;
  t.place({at, at + Vec3(size, 0, 0), at + Vec3(0, 0, size), 1});
  return t;
}

struct Table {
  LightTable table;

  explicit Table(bool sky, size_t panels = 40, size_t lamps = 10, uint32_t seed = 13) {
    Numbers random(seed);
    std::vector<AreaLightTriangle> triangles;
    std::vector<PlacedLight> placed;
    for (size_t i = 0; i < panels; ++i)
      triangles.push_back(panel(random.in_cube(2) + Vec3(0, 3, 0), 0.2f, i % 2 == 0, 0.5f + random()));
    for (size_t i = 0; i < lamps; ++i) {
      PlacedLight lamp;
      lamp.light.type = i % 2 == 0 ? LightType::point : LightType::spot;
      lamp.light.intensity = 0.1f;
      lamp.place.position = random.in_cube(2), lamp.place.direction = random.direction();
      placed.push_back(lamp);
    }
    Environment environment;
    if (sky) {
      PlacedLight sun;
      sun.light.type = LightType::directional;
      placed.push_back(sun);
      environment.tint = Rgb(0.3f);
    }
    Bounds bounds;
    bounds.extend(Vec3(-3)), bounds.extend(Vec3(3, 6, 3));
    table = LightTable(std::move(triangles), std::move(placed), environment, bounds);
  }
};

struct Queries {
  static constexpr size_t kCount = 1000, kRoom = 1008;
  Vec3Lanes<kRoom> from;
  alignas(64) std::array<float, kRoom> choice{}, u0{}, u1{};

  Queries() {
    Numbers random(14);
    for (size_t i = 0; i < kRoom; ++i) {
      from.set(i, random.in_cube(2));
      choice[i] = random(), u0[i] = random(), u1[i] = random();
    }
  }
  std::vector<LightSample> sample(const LightTable& table, LightStrategy strategy) {
    std::vector<LightSample> samples(kCount);
    table.sample({from, choice.data(), u0.data(), u1.data(), kCount}, samples.data(), strategy);
    return samples;
  }
};

TEST(LightTreeInTable, SamplesHaveTheDensitiesThatItStates) {
  for (const bool sky : {false, true}) {
    const Table t(sky);
    Queries queries;
    std::array<int, 3> of_kind{};
    const auto samples = queries.sample(t.table, LightStrategy::tree);
    for (size_t i = 0; i < samples.size(); ++i) {
      const LightSample& s = samples[i];
      if (s.pdf == 0) continue;
      ++of_kind[static_cast<size_t>(s.kind)];
      const Vec3 from = queries.from[i], point = from + s.wi * s.distance;
      const float pdf = s.kind == LightKind::triangle
                            ? t.table.pdf_triangle(s.light, from, point, 0, LightStrategy::tree)
                        : s.kind == LightKind::environment ? t.table.pdf_environment(s.wi, LightStrategy::tree)
                                                           : t.table.probability(s.light, from, LightStrategy::tree);
      EXPECT_NEAR(s.pdf / pdf, 1, 2e-3f);
    }
    EXPECT_GT(of_kind[0], 100);
    EXPECT_GT(of_kind[1], 50);
    EXPECT_EQ(of_kind[2] > 50, sky);
  }
}

TEST(LightTreeInTable, ProbabilitiesSumToOneWithASky) {
  const Table t(true, 0, 9);
  Numbers random(15);
  for (int k = 0; k < 20; ++k) {
    const Vec3 from = random.in_cube(2);
    double sum = 0;
    for (uint32_t light = 0; light < t.table.size(); ++light)
      sum += static_cast<double>(t.table.probability(light, from, LightStrategy::tree));
    EXPECT_LE(sum, 1 + 1e-5);  // spots that look away
    EXPECT_GT(sum, 0.7);
  }
}

// The same sum of light as by power: mean of radiance / density, for a place that every light faces.
TEST(LightTreeInTable, FindsAsMuchLightAsPowerDoes) {
  for (const bool sky : {false, true}) {
    const Table t(sky);
    constexpr int kRounds = 400;
    std::array<double, 2> mean{}, variance{};
    for (const LightStrategy strategy : {LightStrategy::one, LightStrategy::tree}) {
      Numbers random(16 + static_cast<uint32_t>(strategy));
      double sum = 0, squares = 0;
      Queries queries;
      for (int round = 0; round < kRounds; ++round) {
        for (size_t i = 0; i < Queries::kRoom; ++i) {
          queries.from.set(i, Vec3(0.3f, -1, 0.2f));
          queries.choice[i] = random(), queries.u0[i] = random(), queries.u1[i] = random();
        }
        for (const LightSample& s : queries.sample(t.table, strategy)) {
          const double value = s.pdf > 0 ? static_cast<double>(s.radiance.r / s.pdf) : 0;
          sum += value, squares += value * value;
        }
      }
      const double n = static_cast<double>(kRounds) * Queries::kCount;
      const auto k = static_cast<size_t>(strategy != LightStrategy::one);
      mean[k] = sum / n, variance[k] = (squares / n - sqr(mean[k])) / n;
    }
    EXPECT_LT(std::abs(mean[0] - mean[1]), 2.8 * std::sqrt(variance[0] + variance[1]));  // 0.5 % each
    if (!sky) {
      EXPECT_LT(variance[1], variance[0]);
    }
  }
}

TEST(LightTreeInTable, IsWhatManyLightsAreChosenBy) {
  Queries queries;
  const auto same = [&](const Table& t, LightStrategy strategy) {
    const auto a = queries.sample(t.table, LightStrategy::automatic), b = queries.sample(t.table, strategy);
    for (size_t i = 0; i < a.size(); ++i)
      if (a[i].pdf != b[i].pdf) return false;
    return true;
  };
  const Table few(false, 2, 1), many(false);
  EXPECT_TRUE(same(few, LightStrategy::one));
  EXPECT_FALSE(same(few, LightStrategy::tree));
  EXPECT_TRUE(same(many, LightStrategy::tree));
  // A sheet of triangles is one lamp.
  std::vector<AreaLightTriangle> sheet;
  for (int i = 0; i < 36; ++i) sheet.push_back(panel(0.2f * Vec3(i % 6, 0, i / 6) + Vec3(0, 3, 0), 0.2f, false, 1));
  Bounds bounds;
  bounds.extend(Vec3(-3)), bounds.extend(Vec3(3, 6, 3));
  Table one(false);
  one.table = LightTable(std::move(sheet), {}, Environment{}, bounds);
  EXPECT_TRUE(same(one, LightStrategy::one));
  EXPECT_FALSE(same(one, LightStrategy::tree));
}

// A panel that goes up while it turns, and a lamp that goes along: the tree knows all the places they are at.
TEST(LightTreeInTable, BoundsMovingLightsOverTheShutter) {
  Mat4 end(1);
  end[0] = Vec4(0, 1, 0, 0), end[1] = Vec4(-1, 0, 0, 0), end[3] = Vec4(0, 8, 0, 1);
  const test::MovingLights moving(end);
  Bounds bounds;
  bounds.extend(Vec3(-5)), bounds.extend(Vec3(15));
  const LightTable table = moving.table(bounds);
  Numbers random(17);
  for (int k = 0; k < 200; ++k) {
    const Vec3 from = random.in_cube(12);
    const float p = table.probability(0, from, LightStrategy::tree),
                q = table.probability(1, from, LightStrategy::tree);
    EXPECT_GT(p, 0);
    EXPECT_GT(q, 0);
    EXPECT_NEAR(p + q, 1, 1e-5f);
  }
}

}  // namespace
}  // namespace etendue
