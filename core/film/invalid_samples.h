// Samples that were no radiance: how many, why, and where the first of them were.
#pragma once
#include <atomic>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string_view>
#include <vector>

#include "spectrum/rgb.h"

namespace etendue::film {

// Finite and not negative: each comparison is false for NaN.
constexpr bool is_radiance(const Rgb& c) {
  constexpr float kMost = std::numeric_limits<float>::max();
  return c.r >= 0 && c.g >= 0 && c.b >= 0 && c.r <= kMost && c.g <= kMost && c.b <= kMost;
}

enum class InvalidReason { nan, infinite, negative };
std::string_view reason_name(InvalidReason reason);

struct InvalidSample {
  int x = 0, y = 0;
  uint32_t sample = 0;  // counted from zero in its pixel
  InvalidReason reason = InvalidReason::nan;

  friend bool operator==(const InvalidSample&, const InvalidSample&) = default;
};

struct InvalidSamples {
  uint64_t nan = 0, infinite = 0, negative = 0;
  std::vector<InvalidSample> first;  // kListedInvalidSamples of them at most, by sample, row and column

  uint64_t total() const { return nan + infinite + negative; }
};
inline constexpr size_t kListedInvalidSamples = 8;

// Counts them from many threads. Which are the first does not depend on who comes first.
class InvalidSampleCounter {
 public:
  InvalidSampleCounter() = default;
  InvalidSampleCounter(const InvalidSampleCounter& other) { set(other.get()); }
  InvalidSampleCounter& operator=(const InvalidSampleCounter& other) {
    if (this != &other) set(other.get());
    return *this;
  }

  // `radiance` is not finite, or negative; coordinates are below 65536.
  void count(int x, int y, uint32_t sample, const Rgb& radiance);
  InvalidSamples get() const;
  void set(const InvalidSamples& rejected);

 private:
  static constexpr uint64_t kNone = std::numeric_limits<uint64_t>::max();

  std::atomic<uint64_t> nan_{0}, infinite_{0}, negative_{0};
  std::atomic<uint64_t> last_{kNone};  // place of the last one listed, once the list is full
  mutable std::mutex mutex_;
  std::vector<InvalidSample> first_;
};

}  // namespace etendue::film
