#include "base/exact_sum.h"

#include <bit>
#include <cassert>
#include <cmath>

namespace etendue {
namespace {

constexpr uint64_t kLow = 0xffffffffU;

}  // namespace

void ExactSum::add(double x) {
  assert(std::isfinite(x));
  const auto bits = std::bit_cast<uint64_t>(x);
  const uint64_t exponent = bits >> 52 & 0x7ff, fraction = bits & ((uint64_t{1} << 52) - 1);
  // The 53 bits of the number stand at `place`; a denormal number has no hidden bit and the smallest exponent.
  const uint64_t mantissa = exponent > 0 ? fraction | uint64_t{1} << 52 : fraction;
  const uint64_t place = exponent > 0 ? exponent : 1;
  const uint64_t shift = place & 31, rest = mantissa >> (32 - shift);
  const size_t chunk = place >> 5;
  const int64_t sign = bits >> 63 ? -1 : 1;
  chunks_[chunk] += sign * static_cast<int64_t>(mantissa << shift & kLow);
  chunks_[chunk + 1] += sign * static_cast<int64_t>(rest & kLow);
  chunks_[chunk + 2] += sign * static_cast<int64_t>(rest >> 32);
  if (--room_ == 0) carry();
}

void ExactSum::add(const ExactSum& other) {
  ExactSum small = other;
  small.carry();
  if (room_ < 2) carry();
  for (size_t i = 0; i < kChunks; ++i) chunks_[i] += small.chunks_[i];
  --room_;
}

void ExactSum::carry() {
  for (size_t i = 0; i + 1 < kChunks; ++i) {
    chunks_[i + 1] += chunks_[i] >> 32;
    chunks_[i] &= static_cast<int64_t>(kLow);
  }
  room_ = (int64_t{1} << 30) - 1;
}

double ExactSum::value() const {
  ExactSum sum = *this;
  sum.carry();
  const bool negative = sum.chunks_.back() < 0;
  if (negative) {
    for (int64_t& chunk : sum.chunks_) chunk = -chunk;
    sum.carry();
  }
  // From below, so that only the last additions round.
  double value = 0;
  for (size_t i = 0; i < kChunks; ++i)
    value += std::ldexp(static_cast<double>(sum.chunks_[i]), 32 * static_cast<int>(i) + kSmallestExponent);
  return negative ? -value : value;
}

}  // namespace etendue
