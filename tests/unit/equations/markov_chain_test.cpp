// Markov chains: stationary distributions, n-step probabilities in closed form, and chains without a unique one.
#include "equations/markov_chain.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etendue::equations {
namespace {

MarkovChain chain_of(std::vector<std::vector<double>> rows) { return {.states = {}, .transitions = std::move(rows)}; }

// Light between four diffuse surfaces: the next one is any of the other three.
MarkovChain four_surfaces() {
  MarkovChain chain = chain_of(std::vector(4, std::vector(4, 1.0 / 3)));
  for (size_t i = 0; i < 4; ++i) chain.transitions[i][i] = 0;
  return chain;
}

TEST(MarkovChain, StationaryDistributionOfTwoStates) {
  const MarkovChain chain = chain_of({{0.6, 0.4}, {0.6, 0.4}});
  const auto stationary = stationary_distribution(chain);
  ASSERT_TRUE(stationary);
  EXPECT_NEAR((*stationary)[0], 0.6, 1e-14);
  EXPECT_NEAR(eigenvalue_moduli(chain)[1], 0, 1e-14);
  EXPECT_NEAR(total_variation(next_distribution(chain, {0.2, 0.8}), {0.6, 0.4}), 0, 1e-15);
}

TEST(MarkovChain, ProbabilitiesAfterStepsHaveTheClosedForm) {
  const MarkovChain chain = four_surfaces();
  Distribution p{1, 0, 0, 0};
  for (int n = 1; n <= 10; ++n) {
    p = next_distribution(chain, p);
    EXPECT_NEAR(p[0], 0.25 + 0.75 * std::pow(-1.0 / 3, n), 1e-15) << n;
    EXPECT_NEAR(p[1], 0.25 - 0.25 * std::pow(-1.0 / 3, n), 1e-15) << n;
  }
  EXPECT_NEAR(eigenvalue_moduli(chain)[1], 1.0 / 3, 1e-12);
}

TEST(MarkovChain, MetropolisOnARingHasTheTabulatedDistances) {
  const MarkovChain chain =
      chain_of({{0, 0.5, 0, 0.5}, {0.25, 0.25, 0.5, 0}, {0, 1.0 / 3, 1.0 / 6, 0.5}, {0.125, 0, 0.375, 0.5}});
  const Distribution target{0.1, 0.2, 0.3, 0.4};
  EXPECT_NEAR(total_variation(*stationary_distribution(chain), target), 0, 1e-14);
  const std::pair<int, double> expected[] = {{1, 0.4}, {2, 0.225}, {4, 0.0600694}, {8, 0.004357}, {16, 2.359e-5}};
  Distribution p{1, 0, 0, 0};
  int n = 0;
  for (const auto& [steps, distance] : expected) {
    for (; n < steps; ++n) p = next_distribution(chain, p);
    EXPECT_NEAR(total_variation(p, target), distance, 5e-4 * distance) << steps;
  }
}

TEST(MarkovChain, ChainsWithoutUniqueStationaryDistributionAreErrors) {
  const auto failed = stationary_distribution(chain_of({{1, 0}, {0, 1}}));
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.error().message.find("2 independent stationary distributions"), std::string::npos);
  // A periodic chain has a unique one that its distribution does not approach.
  const MarkovChain periodic = chain_of({{0, 1}, {1, 0}});
  EXPECT_NEAR((*stationary_distribution(periodic))[0], 0.5, 1e-14);
  EXPECT_NEAR(eigenvalue_moduli(periodic)[1], 1, 1e-14);
}

TEST(MarkovChain, InvalidMatricesAreErrors) {
  const std::pair<MarkovChain, const char*> cases[] = {
      {chain_of({{0.5, 0.6}, {0.5, 0.5}}), "row 1 of the transition matrix has the sum 1.1"},
      {chain_of({{1, 0}, {1.5, -0.5}}), "row 2 of the transition matrix has the entry -0.5"},
      {chain_of({{1}, {0, 1}}), "has 1 entries; give 2"},
      {chain_of({}), "no states"}};
  for (const auto& [chain, message] : cases) {
    const auto failed = stationary_distribution(chain);
    ASSERT_FALSE(failed) << message;
    EXPECT_NE(failed.error().message.find(message), std::string::npos) << failed.error().message;
  }
}

TEST(MarkovChain, NextStateFollowsTheRow) {
  const MarkovChain chain = chain_of({{0, 0.25, 0.75}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(next_state(chain, 0, 0), 1u);
  EXPECT_EQ(next_state(chain, 0, 0.2499), 1u);
  EXPECT_EQ(next_state(chain, 0, 0.25), 2u);
  EXPECT_EQ(next_state(chain, 0, 0.9999999), 2u);
  EXPECT_EQ(next_state(chain, 1, 0.9999999), 0u);
}

}  // namespace
}  // namespace etendue::equations
