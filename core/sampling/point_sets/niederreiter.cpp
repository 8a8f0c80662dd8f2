#include "sampling/point_sets/niederreiter.h"

#include <bit>

#include "sampling/owen.h"

namespace etendue {
namespace {

// Polynomials over the field of two elements: bit i is the coefficient of x^i.
using Polynomial = uint64_t;

constexpr int degree(Polynomial p) { return static_cast<int>(std::bit_width(p)) - 1; }

constexpr Polynomial product(Polynomial a, Polynomial b) {
  Polynomial result = 0;
  for (; b != 0; b >>= 1, a <<= 1)
    if (b & 1) result ^= a;
  return result;
}

constexpr Polynomial remainder(Polynomial a, Polynomial b) {
  while (degree(a) >= degree(b)) a ^= b << (degree(a) - degree(b));
  return a;
}

constexpr bool is_irreducible(Polynomial p) {
  for (Polynomial d = 2; 2 * degree(d) <= degree(p); ++d)
    if (remainder(p, d) == 0) return false;
  return true;
}

// The coordinates of the samples 2^r; those of other samples are sums without carry.
using DirectionNumbers = std::array<uint32_t, 32>;

DirectionNumbers direction_numbers(Polynomial p) {
  DirectionNumbers numbers{};
  Polynomial power = 1;
  for (int row = 0; row < 32; ++row) {
    const int k = row % degree(p);
    if (k == 0) power = product(power, p);
    // Digits of the Laurent series by long division. The powers of x decrease, so that the first digit of every
    // coordinate changes from the second sample on.
    Polynomial rest = Polynomial{1} << (degree(p) - 1 - k);
    for (uint32_t& number : numbers) {
      rest <<= 1;
      if (degree(rest) < degree(power)) continue;
      rest ^= power;
      number |= 0x80000000U >> row;
    }
  }
  return numbers;
}

using Table = std::array<DirectionNumbers, NiederreiterSampler::kDimensions>;

const Table& table() {
  static const Table all = [] {
    Table t;
    Polynomial p = 2;
    for (DirectionNumbers& numbers : t) {
      while (!is_irreducible(p)) ++p;
      numbers = direction_numbers(p++);
    }
    return t;
  }();
  return all;
}

}  // namespace

uint32_t NiederreiterSampler::point(uint32_t sample, uint32_t dimension) {
  uint32_t result = 0;
  for (const uint32_t number : table()[dimension]) {
    if (sample & 1) result ^= number;
    sample >>= 1;
    if (sample == 0) break;
  }
  return result;
}

void NiederreiterSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const uint32_t seed = hash_combine(pixel_seed, block);
  const bool is_padding = block >= kDimensions / kBlockSize;
  const uint32_t index = is_padding ? owen_scramble(sample, mix_bits(seed)) : sample;
  for (uint32_t k = 0; k < kBlockSize; ++k) {
    const uint32_t x = point(index, is_padding ? k : block * kBlockSize + k);
    out[k] = to_unit_float(scramble(scrambling, x, mix_bits(seed + k * 0x9e3779b9U)));
  }
}

}  // namespace etendue
