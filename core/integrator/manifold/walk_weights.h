// Multiple importance sampling of chains that both walks and BSDF samples find.
//
// Walks find a solution with the density p P, where P is unknown. The number M of walks until one finds the solution takes
// the place of 1 / P, so the weights are random. Each technique makes the walks of M on its own. The weights have the same
// distribution whichever technique found the solution, and the sum 1, so the estimate has no bias.
//
// Solutions that walks seldom find would make bright pixels, because their 1 / P is estimated by a number of walks, too.
// M is large there, which leaves them to BSDF samples.
#pragma once
#include <algorithm>

#include "transport/mis/mis.h"

namespace etendue::integrator::manifold {

class WalkWeights {
 public:
  // `pdf`: p, the density of the target as seen from the start of the chain. `bsdf_pdf`: that of BSDF samples. Both per
  // solid angle at the start of the chain.
  WalkWeights(float pdf, float bsdf_pdf) : pdf_(pdf), bsdf_pdf_(bsdf_pdf) {}

  // Walks have all the weight, without a search.
  bool all() const { return pdf_ > kDominant * bsdf_pdf_; }
  // Walks have no weight.
  bool none() const { return longest_search() < 1; }
  // After how many walks a search ends, because the weight is small if it takes longer.
  int longest_search() const { return static_cast<int>(std::min<float>(kLongestSearch, kSearch * pdf_ / bsdf_pdf_)); }
  // A typical weight.
  float typical() const { return weight(kTypicalSuccess); }
  // The weight if the search found the solution with walk number `walks`.
  float after(int walks) const { return weight(kSuccessOfFirst / static_cast<float>(walks)); }

  // An estimate of the weight over P without bias, from the number of walks of the search, which found the solution, and an
  // estimate of further walks until one finds it again, which is their number if that is at most `certain`. Then either
  // could have been the other, and the estimate is the mean over all ways to divide their sum.
  float over_probability(int walks, float further_walks, int certain) const {
    if (further_walks > static_cast<float>(certain)) return after(walks) * further_walks;
    const int both = walks + static_cast<int>(further_walks);
    const int first = std::max(1, both - certain), last = std::min(longest_search(), both - 1);
    float sum = 0;
    for (int m = first; m <= last; ++m) sum += after(m) * static_cast<float>(both - m);
    return sum / static_cast<float>(last - first + 1);
  }

 private:
  static constexpr float kDominant = 3000, kSearch = 0.2f;
  static constexpr int kLongestSearch = 64;
  static constexpr float kTypicalSuccess = 0.1f;
  // In place of 1 for M = 1: 1 / M is larger than P in expectation, and the variance of the estimate of 1 / P is to reduce
  // the weight.
  static constexpr float kSuccessOfFirst = 0.1f;

  float weight(float success) const {
    return transport::mis_weight(transport::MisHeuristic::power, success * pdf_, bsdf_pdf_);
  }

  float pdf_, bsdf_pdf_;
};

}  // namespace etendue::integrator::manifold
