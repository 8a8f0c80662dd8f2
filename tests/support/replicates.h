// Means over independent renderings, to compare what should agree in expectation: z-tests over blocks of pixels, 1 %
// false alarms for the family.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "support/scenes.h"

namespace etendue::test {

// Pictures of kSize squared, in blocks, so that rare bright paths have become a normal distribution.
inline constexpr int kSize = 16;

struct Estimate {
  std::vector<double> mean, variance;  // per block, of the mean over replicates

  // Of the sum of two that are independent.
  Estimate operator+(const Estimate& other) const;
};

// Means of a picture over its blocks.
using Blocks = std::vector<double>;
Blocks block_means(const film::Film& film);

// Twelve pictures, each made with a seed of its own from `first_seed` on.
Estimate replicated(const std::function<Blocks(uint64_t seed)>& picture, uint64_t first_seed = 1000);
// Twelve renderings.
Estimate replicated(render::Document document, uint32_t samples, uint64_t first_seed = 1000);

// Expects every block, and all of them together, to agree. A test that makes several comparisons says how many: the
// family is all of them.
void expect_agreement(const Estimate& a, const Estimate& b, const std::string& what, int comparisons = 1);

// Rough metal, rough and smooth glass, a sheet, glazed clay under an area light and an environment: every lobe and
// every weight takes part.
render::Document glossy_things();

}  // namespace etendue::test
