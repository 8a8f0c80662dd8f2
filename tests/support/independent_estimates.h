// Means over independent renderings, for comparisons of estimators with the same expectation: t-tests over blocks of
// pixels with a family-wise false-alarm rate of 1 %.
//
// With a sanitizer there are two renderings instead of twelve, variances are 0, and nothing is compared: such a run examines
// what the program does with its memory and threads, and would otherwise take hours.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "support/scenes.h"

namespace etendue::test {

// Images have kSize x kSize pixels. Means over blocks are used because they are nearly normally distributed in spite of
// rare bright paths.
inline constexpr int kSize = 16;

struct Estimate {
  std::vector<double> mean, variance;  // per block, of the mean over the renderings

  // The sum of two independent estimates.
  Estimate operator+(const Estimate& other) const;
};

// Means of an image over its blocks.
using Blocks = std::vector<double>;
Blocks block_means(const film::Film& film);

// Twelve images with seeds from `first_seed` on.
Estimate replicated(const std::function<Blocks(uint64_t seed)>& image, uint64_t first_seed = 1000);
// Twelve renderings.
Estimate replicated(render::Document document, uint32_t samples, uint64_t first_seed = 1000);

// Expects every block and the mean of all blocks to agree. `comparisons` is the number of comparisons of the whole
// test, which form the family. A block with less than a twentieth of the mean radiance is left out if the standard error
// of an estimate exceeds a third of its mean: too few samples reach it for a normal distribution.
void expect_agreement(const Estimate& a, const Estimate& b, const std::string& what, int comparisons = 1);

// Rough metal, rough and smooth glass, a thin sheet and glazed clay under an area light and an environment. Every kind
// of lobe and every kind of MIS weight occurs.
render::Document glossy_scene();

}  // namespace etendue::test
