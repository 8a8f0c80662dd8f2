// The Metropolis sampler shared by the Markov chain integrators, on targets with known means [Lang, sec. 9.4; Veach
// 1997].
#include "integrator/markov_chain/metropolis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "base/state_bytes.h"
#include "integrator/markov_chain/seed_selection.h"

namespace etendue::integrator {
namespace {

// Two states with f = 1 and f = 3 and symmetric proposals. Recording every iteration gives 1/4 and 3/4; recording
// accepted states only would give 1/2 each. The tolerance is 4.5 standard errors of a chain with correlation -1/3.
TEST(Metropolis, EveryIterationIsRecorded) {
  constexpr double kTarget[] = {1, 3};
  constexpr int kIterations = 400000;
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform;
  double counted[2] = {0, 0}, went[2] = {0, 0};
  size_t at = 0;
  Occupancy occupancy;
  Acceptance acceptance;
  for (int i = 0; i < kIterations; ++i) {
    const size_t next = 1 - at;
    const AcceptanceDecision decision = decide_acceptance(kTarget[at], kTarget[next], uniform(engine));
    acceptance.count(decision);
    occupancy.record(
        decision, [&](double n) { counted[at] += n; }, [&](double n) { counted[next] += n; });
    if (decision.accepted) {
      at = next;
      went[at] += 1;
    }
  }
  counted[at] += occupancy.take_remaining();
  EXPECT_NEAR(counted[0] + counted[1], kIterations, 1e-6);
  EXPECT_NEAR(counted[1] / kIterations, 0.75, 4.5 * std::sqrt(0.25 * 0.75 * 0.5 / kIterations));
  EXPECT_NEAR(went[1] / (went[0] + went[1]), 0.5, 1e-5);
  EXPECT_NEAR(static_cast<double>(acceptance.accepted) / static_cast<double>(acceptance.proposed), 0.5, 0.005);
}

// Asymmetric proposals: the acceptance probability compensates the ratio of the proposal densities.
TEST(Metropolis, AsymmetricProposalsAreCompensated) {
  constexpr double kTarget[] = {1, 3}, kProposed[] = {0.9, 0.4};  // probability of proposing the other state
  constexpr int kIterations = 400000;
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> uniform;
  double counted[2] = {0, 0};
  size_t at = 0;
  Occupancy occupancy;
  for (int i = 0; i < kIterations; ++i) {
    const size_t next = uniform(engine) < kProposed[at] ? 1 - at : at;
    const double back = next == at ? 1 : kProposed[next] / kProposed[at];
    const AcceptanceDecision decision = decide_acceptance(kTarget[at], kTarget[next], uniform(engine), back);
    occupancy.record(
        decision, [&](double n) { counted[at] += n; }, [&](double n) { counted[next] += n; });
    if (decision.accepted) at = next;
  }
  counted[at] += occupancy.take_remaining();
  EXPECT_NEAR(counted[1] / kIterations, 0.75, 4.5 * std::sqrt(0.25 * 0.75 / kIterations));
}

TEST(Metropolis, InvalidValuesAreNeverAccepted) {
  for (const double nothing : {0.0, -1.0, std::nan("")}) {
    EXPECT_FALSE(decide_acceptance(1, nothing, 0).accepted);
    EXPECT_FALSE(decide_acceptance(0, nothing, 0).accepted);
  }
  EXPECT_TRUE(decide_acceptance(0, 1e-30, 0.999).accepted);
}

// f(x) = x on [0, 1] with proposals of up to 0.05, reflected at the ends. With starts selected in proportion to f
// (bootstrap weight W_0), the estimate of the integral over [0.9, 1] is 0.095 after any number of iterations. With
// uniform starts and the exact normalisation 1/2, the expectation is that of `mean_of_uniform_start`.
constexpr double kIntegral = 0.095;

// The expectation after `iterations` steps without the first `discarded` ones, from the densities of the chain on a
// grid.
double mean_of_uniform_start(int iterations, int discarded = 0) {
  constexpr int kCells = 200, kReach = kCells / 20;
  std::vector<double> density(kCells, 1.0 / kCells), next(kCells);
  double sum = 0;
  for (int n = 1; n <= iterations; ++n) {
    std::ranges::fill(next, 0.0);
    for (int x = 0; x < kCells; ++x)
      for (int step = -kReach; step <= kReach; ++step) {
        const double proposed = density[static_cast<size_t>(x)] * (std::abs(step) == kReach ? 0.5 : 1) / (2 * kReach);
        const int far = x + step < 0 ? -1 - x - step : x + step, y = std::min(far, 2 * kCells - 1 - far);
        const double accepted = std::min(1.0, (y + 0.5) / (x + 0.5));
        next[static_cast<size_t>(y)] += proposed * accepted;
        next[static_cast<size_t>(x)] += proposed * (1 - accepted);
      }
    density.swap(next);
    if (n > discarded) sum += 0.5 * std::accumulate(density.begin() + kCells * 9 / 10, density.end(), 0.0);
  }
  return sum / (iterations - discarded);
}

// The expected values come from a simulation with errors of about 0.0005.
TEST(Metropolis, StartUpBiasMatchesTabulatedValues) {
  constexpr std::pair<int, double> kTable[] = {{1, 0.0505}, {5, 0.0506}, {50, 0.0544}, {500, 0.0774}};
  for (const auto& [iterations, mean] : kTable)
    EXPECT_NEAR(mean_of_uniform_start(iterations), mean, 6e-4) << iterations;
  EXPECT_NEAR(mean_of_uniform_start(500, 250), 0.0868, 6e-4);
}

struct Interval {
  double mean, error;
};
Interval integral_near_one(int iterations, bool chosen) {
  constexpr int kRounds = 200, kCandidates = 64;
  constexpr size_t kChains = 16;
  std::mt19937_64 engine(static_cast<uint64_t>(iterations));
  std::uniform_real_distribution<double> uniform;
  double sum = 0, squares = 0;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<float> weight(kCandidates);
    double total = 0;
    for (float& w : weight) {
      w = static_cast<float>(uniform(engine));
      total += double{w};
    }
    auto starts = select_seeds(weight, kChains, uniform(engine));
    EXPECT_EQ(starts.size(), kChains);
    if (!chosen)
      for (size_t i = 0; i < kChains; ++i) starts[i] = static_cast<uint32_t>(i);
    const double b = chosen ? total / kCandidates : 0.5;
    double found = 0;
    const auto record = [&](double x, double n) { found += x >= 0.9 ? n : 0; };
    for (const uint32_t start : starts) {
      double x = double{weight[start]};
      Occupancy occupancy;
      for (int i = 0; i < iterations; ++i) {
        double y = std::abs(x + 0.1 * uniform(engine) - 0.05);
        if (y > 1) y = 2 - y;
        const AcceptanceDecision decision = decide_acceptance(x, y, uniform(engine));
        occupancy.record(
            decision, [&](double n) { record(x, n); }, [&](double n) { record(y, n); });
        if (decision.accepted) x = y;
      }
      record(x, occupancy.take_remaining());
    }
    const double estimate = b * found / (static_cast<double>(kChains) * iterations);
    sum += estimate;
    squares += estimate * estimate;
  }
  const double mean = sum / kRounds;
  return {mean, std::sqrt((squares / kRounds - mean * mean) / kRounds)};
}

TEST(Metropolis, SelectedStartsAreUnbiased) {
  for (const int iterations : {1, 5, 50, 500}) {
    const Interval chosen = integral_near_one(iterations, true), naive = integral_near_one(iterations, false);
    EXPECT_NEAR(chosen.mean, kIntegral, 4.5 * chosen.error) << iterations;
    EXPECT_NEAR(naive.mean, mean_of_uniform_start(iterations), 4.5 * naive.error) << iterations;
    EXPECT_LT(naive.mean, kIntegral - 4.5 * naive.error) << iterations;
  }
}

TEST(Metropolis, StartsAreSelectedByWeight) {
  const std::vector<float> weight{0, 1, 0, 2.5f, 0.5f, 0};
  EXPECT_EQ(select_seeds(weight, 8, 0.5), (std::vector<uint32_t>{1, 1, 3, 3, 3, 3, 3, 4}));
  EXPECT_TRUE(select_seeds(std::vector<float>(5, 0), 8, 0.5).empty());
}

TEST(ChainState, ReadsBackWithoutReadingBeyondItsEnd) {
  StateWriter out;
  out.value(int32_t{7});
  out.list(std::span<const float>(std::vector<float>{1, 2, 3}));
  const auto bytes = out.take();
  StateReader in(bytes);
  int32_t number = 0;
  std::vector<float> list;
  ASSERT_TRUE(in.value(number) && in.list(list) && in.at_end());
  EXPECT_EQ(number, 7);
  EXPECT_EQ(list, (std::vector<float>{1, 2, 3}));
  StateReader cut({bytes.data(), bytes.size() - 1});
  EXPECT_TRUE(cut.value(number));
  EXPECT_FALSE(cut.list(list));
}

}  // namespace
}  // namespace etendue::integrator
