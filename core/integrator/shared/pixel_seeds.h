// The seeds of the random numbers of pixels in one half-buffer.
#pragma once
#include "base/hash.h"
#include "film/half_buffers.h"
#include "sampling/sampler.h"

namespace etendue::integrator {

// Seeds are hashes of the pixel. For samplers with tiles, they consist of a hash of the tile and the place in it.
class PixelSeeds {
 public:
  PixelSeeds(const Sampler& sampler, uint64_t seed, uint32_t half_buffer)
      : tile_bits_(sampler.tile_bits()), hash_(mix_bits(seed * film::kHalfBuffers + half_buffer + 1)) {}

  uint32_t operator()(int x, int y) const {
    if (tile_bits_ > 0) [[unlikely]]
      return place_in_tile(hashed(x >> tile_bits_, y >> tile_bits_), static_cast<uint32_t>(x),
                           static_cast<uint32_t>(y), tile_bits_);
    return hashed(x, y);
  }

 private:
  uint32_t hashed(int x, int y) const {
    const uint64_t place = static_cast<uint64_t>(static_cast<uint32_t>(y)) << 32 | static_cast<uint32_t>(x);
    return static_cast<uint32_t>(mix_bits(hash_ ^ place) >> 32);
  }

  int tile_bits_;
  uint64_t hash_;
};

}  // namespace etendue::integrator
