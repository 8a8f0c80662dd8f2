// A statistical test for local modifications of an image: blocks of pixels are compared with another rendering.
//
// For each block the sum of differences is divided by its standard error. The variance of the tested image is the
// larger of two estimates: the image's own, and that of the other rendering scaled to the sample count. An image whose
// samples missed a rare bright path underestimates its variance. The variance of a block is the maximum of its own and
// the average over its neighbourhood, because a single block contains few values to estimate it from.
#pragma once
#include <span>
#include <vector>

#include "film/film.h"

namespace etendue::advisor {

struct Block {
  int x = 0, y = 0;   // of its first pixel
  double sigmas = 0;  // signed difference in standard errors
};

struct BlockTest {
  static constexpr int kSide = 4;  // pixels
  // The threshold. With normally distributed block sums, one unmodified image in 1000 has a block above it by chance.
  double max_sigmas = 0;
  size_t blocks = 0;           // number of blocks tested
  std::vector<Block> changed;  // blocks above the threshold, the largest difference first
};

struct TestedImage {
  std::span<const float> rgb, variance;  // three numbers per pixel; variance may be empty
  uint32_t samples = 0;                  // per pixel; 0 if unknown
};

// `other` has the same number of samples in both half-buffers, at least two in total.
BlockTest test_blocks(const TestedImage& tested, const film::Film& other);

}  // namespace etendue::advisor
