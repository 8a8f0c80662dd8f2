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
  const uint64_t exponent = bits >> 52 & 0x7ff;
  const uint64_t fraction = bits & ((uint64_t{1} << 52) - 1);
  // The mantissa is shifted to bit `position` of the chunks. A denormal number has no hidden bit, and its exponent
  // is 1.
  const uint64_t mantissa = exponent > 0 ? fraction | uint64_t{1} << 52 : fraction;
  const uint64_t position = exponent > 0 ? exponent : 1;
  const uint64_t shift = position & 31, rest = mantissa >> (32 - shift);
  const size_t chunk = position >> 5;
  const int64_t sign = bits >> 63 ? -1 : 1;
  chunks_[chunk] += sign * static_cast<int64_t>(mantissa << shift & kLow);
  chunks_[chunk + 1] += sign * static_cast<int64_t>(rest & kLow);
  chunks_[chunk + 2] += sign * static_cast<int64_t>(rest >> 32);
  if (--terms_until_carry_ == 0) carry();
}

void ExactSum::add(const ExactSum& other) {
  ExactSum small = other;
  small.carry();
  if (terms_until_carry_ < 2) carry();
  for (size_t i = 0; i < kChunks; ++i) chunks_[i] += small.chunks_[i];
  --terms_until_carry_;
}

void ExactSum::carry() {
  for (size_t i = 0; i + 1 < kChunks; ++i) {
    chunks_[i + 1] += chunks_[i] >> 32;
    chunks_[i] &= static_cast<int64_t>(kLow);
  }
  terms_until_carry_ = (int64_t{1} << 30) - 1;
}

double ExactSum::value() const {
  ExactSum sum = *this;
  sum.carry();
  const bool negative = sum.chunks_.back() < 0;
  if (negative) {
    for (int64_t& chunk : sum.chunks_) chunk = -chunk;
    sum.carry();
  }
  // Starts with the smallest chunk, so that only the last additions round.
  double value = 0;
  for (size_t i = 0; i < kChunks; ++i)
    value += std::ldexp(static_cast<double>(sum.chunks_[i]), 32 * static_cast<int>(i) + kSmallestExponent);
  return negative ? -value : value;
}

}  // namespace etendue
