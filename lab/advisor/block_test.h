// Whether a picture was changed in places: blocks of pixels against another rendering.
//
// In each block the sum of differences is compared with its standard error, from what both pictures say of their
// variance and from what the other's variance says of the picture's, whichever is larger: a picture that never met a
// rare bright path does not know of it. Variances of a block and of its neighbours are pooled, as a block alone has few
// numbers to tell it from.
#pragma once
#include <span>
#include <vector>

#include "film/film.h"

namespace etendue::advisor {

struct Block {
  int x = 0, y = 0;   // of its first pixel
  double sigmas = 0;  // by which it is off, with its sign
};

struct BlockTest {
  static constexpr int kSide = 4;  // pixels
  // By chance, one honest picture in a thousand has a block that is off by more, as far as sums over a block are
  // normal.
  double most_sigmas = 0;
  size_t blocks = 0;
  std::vector<Block> changed;  // the worst first
};

struct Judged {
  std::span<const float> picture, variance;  // three numbers per pixel; variance may be empty
  uint32_t samples = 0;                      // per pixel; 0 if unknown
};

// `other` holds the same number of samples in both halves, two at least.
BlockTest changed_blocks(const Judged& judged, const film::Film& other);

}  // namespace etendue::advisor
