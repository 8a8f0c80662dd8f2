// A sum of doubles without any rounding, so that the order of its terms does not matter: what threads add up apart and
// merge in whatever order has the same bits.                    R. M. Neal, "Fast Exact Summation", 2015 (the small
// one)
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
  // Within one unit in the last place of the true sum.
  double value() const;

 private:
  // Chunk i counts units of 2^(32 i - 1075). Terms of less than 2^32 leave room for 2^31 of them; `carry` makes room
  // anew.
  static constexpr size_t kChunks = 67;
  static constexpr int kSmallestExponent = -1075;
  void carry();

  std::array<int64_t, kChunks> chunks_{};
  int64_t room_ = int64_t{1} << 30;
};

}  // namespace etendue
