// Lookups of photons in volumes, and random subsets of photons.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "integrator/photon/kernel.h"
#include "integrator/photon/photon_map.h"
#include "integrator/shared/random_subset.h"

namespace etendue::photon {
namespace {

std::vector<Photon> photons_in_a_cube(size_t count, uint32_t seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> number(0, 1);
  std::vector<Photon> photons;
  for (size_t i = 0; i < count; ++i) {
    const float x = number(engine), y = number(engine), z = number(engine);
    photons.push_back({{x, y, z}, {0, 1, 0}, {0, 1, 0}, Rgb(1), 1});
  }
  return photons;
}

TEST(PhotonMap, NearestInABallEqualBruteForce) {
  const auto photons = photons_in_a_cube(2000, 3);
  PhotonMap map;
  map.build(photons);
  Neighbourhood ball;
  for (const Photon& center : photons_in_a_cube(100, 4)) {
    std::vector<float> all;
    for (const Photon& p : photons) {
      const Vec3 d = p.position() - center.position();
      all.push_back(glm::dot(d, d));
    }
    std::ranges::sort(all);
    map.find_nearest_in_ball(center.position(), 30, kInfinity, ball);
    std::vector<float> found;
    map.for_each(ball, [&](const Photon&, float d2) { found.push_back(d2); });
    std::ranges::sort(found);
    EXPECT_EQ(found, std::vector<float>(all.begin(), all.begin() + 29));
    EXPECT_EQ(ball.radius2(), all[29]);
    const float limit = sqr(0.15f);
    std::vector<float> visited;
    map.find_within_ball(center.position(), limit, ball);
    map.for_each(ball, [&](const Photon&, float d2) { visited.push_back(d2); });
    std::ranges::sort(visited);
    EXPECT_EQ(visited, std::vector<float>(all.begin(), std::ranges::lower_bound(all, limit)));
  }
}

// Every kernel has mean one over the disc, where t is uniform, and over the ball, where t^(3/2) is.
TEST(Kernels, HaveMeanOne) {
  for (const Kernel kernel : {Kernel::constant, Kernel::cone, Kernel::gaussian}) {
    constexpr int kSteps = 100'000;
    double disc = 0, ball = 0;
    for (int i = 0; i < kSteps; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / kSteps;
      disc += double{kernel_weight(kernel, u)} / kSteps;
      ball += double{kernel_weight(kernel, std::pow(u, 2.0f / 3), Region::ball)} / kSteps;
    }
    EXPECT_NEAR(disc, 1, 1e-3);
    EXPECT_NEAR(ball, 1, 1e-3);
  }
}

// Every element has the expectation of its weight. 4.5 standard errors of a binomial distribution.
TEST(RandomSubset, KeepsExpectations) {
  constexpr size_t kCount = 50, kMost = 20;
  constexpr int kTrials = 20'000;
  std::vector<double> sums(kCount, 0);
  struct Element {
    size_t number;
    float weight;
  };
  for (uint32_t trial = 0; trial < kTrials; ++trial) {
    std::vector<Element> elements;
    for (size_t i = 0; i < kCount; ++i) elements.push_back({i, 1});
    integrator::thin_randomly(elements, kMost, trial, [](Element& e, float factor) { e.weight *= factor; });
    ASSERT_EQ(elements.size(), kMost);
    for (const Element& e : elements) sums[e.number] += double{e.weight};
  }
  const double share = double{kMost} / kCount, error = std::sqrt((1 / share - 1) / kTrials);
  for (const double sum : sums) EXPECT_NEAR(sum / kTrials, 1, 4.5 * error);
  std::vector<int> few{1, 2, 3};
  integrator::thin_randomly(few, 3, 1, [](int& e, float) { e = 0; });
  EXPECT_EQ(few, (std::vector<int>{1, 2, 3}));
}

}  // namespace
}  // namespace etendue::photon
