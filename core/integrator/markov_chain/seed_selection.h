// Selection of the first states of Markov chains without start-up bias.
//                                                [Lang, Remark 9.18, eq. 9.113-9.118, corrected; Veach and Guibas 1997]
//
// A chain that starts at x_0 with density p_0 and counts f(x_0) / p_0(x_0) in every iteration is unbiased from the
// first iteration. Of n bootstrap samples with weights W_i, chains start at some that are chosen in proportion to W_i,
// and all of them count
//
//   b = 1/n sum of W_i
//
// instead: the expected number of chains that start at sample i is (chains W_i) / (n b).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace etendue::integrator {

// The indices of the bootstrap samples at which the chains start, in ascending order (systematic resampling): each
// occurs as often as its share of the total weight, rounded up or down. `u` is uniform in [0, 1). Empty if all weights
// are zero.
inline std::vector<uint32_t> select_seeds(std::span<const float> weight, size_t chains, double u) {
  double total = 0;
  for (const float w : weight) total += double{w};
  std::vector<uint32_t> seeds;
  if (!(total > 0)) return seeds;
  seeds.reserve(chains);
  double sum = 0;
  for (size_t i = 0; i < weight.size(); ++i) {
    if (!(weight[i] > 0)) continue;
    sum += double{weight[i]};
    while (seeds.size() < chains && (static_cast<double>(seeds.size()) + u) * total < sum * static_cast<double>(chains))
      seeds.push_back(static_cast<uint32_t>(i));
  }
  // Fills up what rounding leaves missing.
  while (seeds.size() < chains) seeds.push_back(seeds.back());
  return seeds;
}

}  // namespace etendue::integrator
