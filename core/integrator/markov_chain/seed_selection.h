// Where Markov chains start so that nothing of their start is left in the mean.
//                                                           thesis Remark 9.18, (9.113)-(9.118); errata E28; digest:
//                                                           S24
//
// A chain that starts at x_0 with density p_0 and counts f(x_0) / p_0(x_0) in every iteration is unbiased from the
// first one on. Of n candidates, chains start at some, chosen in proportion to that worth W_i, and all count
//
//   b = 1/n sum of W_i
//
// in its place: the expected number of chains that start at candidate i is (chains W_i) / (n b).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace etendue::integrator {

// The candidates at which so many chains start, in ascending order, each as often as its share asks for, rounded up or
// down; `u` is uniform in [0, 1). None if no candidate is worth anything.
inline std::vector<uint32_t> choose_starts(std::span<const float> weight, size_t chains, double u) {
  double total = 0;
  for (const float w : weight) total += double{w};
  std::vector<uint32_t> chosen;
  if (!(total > 0)) return chosen;
  chosen.reserve(chains);
  double sum = 0;
  for (size_t i = 0; i < weight.size(); ++i) {
    if (!(weight[i] > 0)) continue;
    sum += double{weight[i]};
    while (chosen.size() < chains &&
           (static_cast<double>(chosen.size()) + u) * total < sum * static_cast<double>(chains))
      chosen.push_back(static_cast<uint32_t>(i));
  }
  // What rounding may leave over.
  while (chosen.size() < chains) chosen.push_back(chosen.back());
  return chosen;
}

}  // namespace etendue::integrator
