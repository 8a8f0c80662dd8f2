// Distribution ray tracing [Cook et al. 1984; Lang, eq. 8.37, corrected, and fig. 8.18, corrected]. With one branch per
// vertex it equals path tracing, bit for bit. More branches leave the mean unchanged and reduce the variance.
#include <gtest/gtest.h>

#include <numeric>

#include "render/session.h"
#include "sampling/sampler.h"
#include "support/independent_estimates.h"

namespace etendue::distribution_test {
namespace {

using test::expect_agreement;
using test::replicated;
using test::same_bits;

using Settings = std::vector<std::pair<std::string, std::string>>;

render::Document with(render::Document d, const Settings& settings) {
  for (const auto& [name, value] : settings) {
    const auto changed = render::with_text(d, name, value);
    EXPECT_TRUE(changed) << changed.error().message;
    if (changed) d = *changed;
  }
  return d;
}

render::Document branching(const render::Document& d, int first, int second, int third, const Settings& more = {}) {
  return with(with(d, {{"render.integrator", "distribution"},
                       {"branches-1", std::to_string(first)},
                       {"branches-2", std::to_string(second)},
                       {"branches-3", std::to_string(third)}}),
              more);
}

// Without branching the ray tree is a single path.
TEST(Distribution, OneBranchEqualsPathTracingBitForBit) {
  for (const auto& d : {test::cornell(test::kSize), test::glossy_scene()})
    for (const auto& sampler : sampler_infos())
      for (const char* paths : {"", "E.*S.*L|EDL"}) {
        const Settings common{{"render.sampler", sampler.name}, {"film.paths", paths}};
        const auto tree = branching(with(d, common), 1, 1, 1);
        EXPECT_TRUE(same_bits(test::rendered(tree, 8), test::rendered(with(d, common), 8))) << sampler.name << paths;
        const auto naive = with(tree, {{"shadow-rays", "off"}});
        const auto pure = with(with(d, common), {{"render.integrator", "path-pure"}});
        EXPECT_TRUE(same_bits(test::rendered(naive, 8), test::rendered(pure, 8))) << sampler.name << paths;
      }
}

TEST(Distribution, MeanIsIndependentOfBranching) {
  for (const auto& d : {test::cornell(test::kSize), test::glossy_scene()}) {
    const auto path = replicated(d, 256);
    const std::pair<const char*, render::Document> trees[] = {
        {"splitting", branching(d, 4, 1, 1, {{"branching", "first-rough"}})},
        {"splitting, early roulette", branching(d, 3, 1, 1, {{"branching", "first-rough"}, {"roulette-start", "1"}})},
        {"splitting, no shadow rays", branching(d, 6, 1, 1, {{"branching", "first-rough"}, {"shadow-rays", "off"}})},
        {"4 2 1", branching(d, 4, 2, 1)},
        {"2 3 2, early roulette", branching(d, 2, 3, 2, {{"roulette-start", "1"}})},
        {"1 1 5, every light", branching(d, 1, 1, 5, {{"lights", "every"}})},
        {"1 1 1, every light", branching(d, 1, 1, 1, {{"lights", "every"}})},
        {"6 2 1, no shadow rays", branching(d, 6, 2, 1, {{"shadow-rays", "off"}, {"heuristic", "balance"}})}};
    for (const auto& [name, tree] : trees) expect_agreement(replicated(tree, 48, 2000), path, name, 16);
  }
}

// Light after one diffuse reflection is averaged over the branches, so its variance falls with their number.
TEST(Distribution, VarianceFallsWithTheNumberOfBranches) {
  const auto d = with(test::cornell(test::kSize), {{"render.sampler", "random"}, {"film.paths", "EDDL"}});
  const auto variance = [&](int branches) {
    const auto estimate = replicated(branching(d, branches, 1, 1), 16);
    return std::accumulate(estimate.variance.begin(), estimate.variance.end(), 0.0);
  };
  const double one = variance(1), four = variance(4), sixteen = variance(16);
  // The bound allows for the noise of the pixel sample, which remains, and for the error of the estimated variances,
  // about a quarter: 16 blocks with 11 degrees of freedom each.
  EXPECT_LT(four, 0.45 * one);
  EXPECT_LT(sixteen, 0.45 * four);
}

// In a scene without specular surfaces, splitting is branching at the first vertex without the factor N in the densities of
// the weights. Without light samples there are no weights.
TEST(Distribution, SplittingBranchesAtTheFirstRoughVertex) {
  const auto d = branching(test::cornell(test::kSize), 4, 1, 1, {{"shadow-rays", "off"}});
  EXPECT_TRUE(same_bits(test::rendered(with(d, {{"branching", "first-rough"}}), 8), test::rendered(d, 8)));
  const auto one = branching(test::glossy_scene(), 1, 1, 1);
  EXPECT_TRUE(same_bits(test::rendered(with(one, {{"branching", "first-rough"}}), 8), test::rendered(one, 8)));
}

// N_1 + N_1 N_2 + ... rays per camera ray in a lossless room; path tracing has one ray per edge [Lang, sec. 8.4].
TEST(Distribution, RayCountIsTheSumOfProductsOfBranches) {
  const auto room = test::document(test::furnace(0.9f), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1), 16, 16);
  const auto rays = [&](int branches, int depth) {
    auto d = branching(room, branches, branches, branches,
                       {{"shadow-rays", "off"}, {"roulette-start", "64"}, {"max-depth", std::to_string(depth + 1)}});
    d.limits = {2, 0, 0};
    render::Session session({.threads = 1, .interactive = false});
    session.submit(d);
    session.finish();
    return session.status().rays / (2 * 16 * 16);
  };
  EXPECT_EQ(rays(1, 4), 1U + 4U);
  EXPECT_EQ(rays(3, 3), 1U + 3 + 9 + 27);
  EXPECT_EQ(rays(10, 3), 1U + 10 + 100 + 1000);
  EXPECT_EQ(rays(10, 4), 1U + 10 + 100 + 1000 + 1000) << "later vertices have one branch";
}

}  // namespace
}  // namespace etendue::distribution_test
