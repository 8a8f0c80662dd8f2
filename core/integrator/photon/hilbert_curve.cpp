#include "integrator/photon/hilbert_curve.h"

#include <algorithm>

namespace etendue::photon {
namespace {

// Two zero bits between the lowest ten bits.
constexpr uint32_t spread(uint32_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}
constexpr uint32_t interleave(uint32_t x, uint32_t y, uint32_t z) {
  return spread(x) << 2 | spread(y) << 1 | spread(z);
}

// If a bit of `b` is set, inverts the lower bits of `a`; otherwise exchanges them with those of `b`.
inline void invert_or_exchange(uint32_t& a, uint32_t& b, int bit) {
  const uint32_t lower = (1U << bit) - 1, is_set = 0U - (b >> bit & 1);
  a ^= lower & is_set;
  const uint32_t difference = (a ^ b) & lower & ~is_set;
  a ^= difference;
  b ^= difference;
}

uint32_t cell_of(float x) {
  constexpr auto kCells = static_cast<float>(1 << kHilbertAxisBits);
  return static_cast<uint32_t>(static_cast<int32_t>(std::max(0.0f, std::min(x * kCells, kCells - 1))));
}

}  // namespace

ETENDUE_VECTORIZE void find_hilbert_positions(const Cube& cube, const Vec3LanesView& points, size_t count,
                                              uint64_t* positions) {
  constexpr int kLowBits = 6;
  const float scale = 1 / cube.size;
#pragma GCC ivdep
  for (size_t i = 0; i < padded_lanes(count); ++i) {
    uint32_t x = cell_of((points.x[i] - cube.corner.x) * scale);
    uint32_t y = cell_of((points.y[i] - cube.corner.y) * scale);
    uint32_t z = cell_of((points.z[i] - cube.corner.z) * scale);
#pragma GCC unroll 16
    for (int bit = kHilbertAxisBits - 1; bit > 0; --bit) {
      x ^= ((1U << bit) - 1) & (0U - (x >> bit & 1));
      invert_or_exchange(x, y, bit);
      invert_or_exchange(x, z, bit);
    }
    // Gray code of the position.
    y ^= x;
    z ^= y;
    uint32_t parity = z >> 1;  // of all higher bits
    parity ^= parity >> 1;
    parity ^= parity >> 2;
    parity ^= parity >> 4;
    parity ^= parity >> 8;
    x ^= parity;
    y ^= parity;
    z ^= parity;
    const uint64_t high = interleave(x >> kLowBits, y >> kLowBits, z >> kLowBits);
    constexpr uint32_t kLowMask = (1U << kLowBits) - 1;
    positions[i] = high << 3 * kLowBits | interleave(x & kLowMask, y & kLowMask, z & kLowMask);
  }
}

}  // namespace etendue::photon
