// Exact summation of doubles [Neal 2015, "small superaccumulator"].
//
// The sum is exact, so it does not depend on the order of its terms. Partial sums of several threads can be merged in
// any order and give the same bits.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace etendue {

class ExactSum {
 public:
  // `x` must be finite.
  void add(double x);
  void add(const ExactSum& other);
  // The sum, within one unit in the last place.
  double value() const;

 private:
  // Chunk i counts units of 2^(32 i - 1075). Each term adds less than 2^32 to a chunk, so a 64-bit chunk has room for
  // 2^31 terms. `carry` moves the upper bits of each chunk to the next one, which makes room again.
  static constexpr size_t kChunks = 67;
  static constexpr int kSmallestExponent = -1075;
  void carry();

  std::array<int64_t, kChunks> chunks_{};
  int64_t terms_until_carry_ = int64_t{1} << 30;
};

}  // namespace etendue
