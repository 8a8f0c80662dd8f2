// Invalid samples: values that are not finite, or that no light has
//
// The film counts them by reason and records where the first ones occurred.
#pragma once
#include <atomic>
#include <bit>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string_view>
#include <vector>

#include "spectrum/rgb.h"

namespace etendue::film {

// Whether the components are finite, and X, Y and Z are not negative up to rounding. Colours outside the sRGB gamut, which
// single wavelengths have, satisfy this with negative components.
bool is_visible_color(const Rgb& c);

// Whether a sample is valid. The bits of floats from 0 to infinity ascend; those of negative numbers and NaN are larger.
inline bool is_radiance(const Rgb& c) {
  const auto in_range = [](float v) {
    return std::bit_cast<uint32_t>(v) <= std::bit_cast<uint32_t>(std::numeric_limits<float>::max());
  };
  return (in_range(c.r) && in_range(c.g) && in_range(c.b)) || is_visible_color(c);
}

enum class InvalidReason { nan, infinite, negative };
std::string_view reason_name(InvalidReason reason);

struct InvalidSample {
  int x = 0, y = 0;
  uint32_t sample = 0;  // index in its pixel, from 0
  InvalidReason reason = InvalidReason::nan;

  friend bool operator==(const InvalidSample&, const InvalidSample&) = default;
};

inline constexpr size_t kListedInvalidSamples = 8;

struct InvalidSamples {
  uint64_t nan = 0, infinite = 0, negative = 0;  // numbers of samples
  std::vector<InvalidSample> first;              // at most kListedInvalidSamples, ordered by sample, row and column

  uint64_t total() const { return nan + infinite + negative; }
};

// Adds the counts and the list of `other`.
void merge(InvalidSamples& samples, const InvalidSamples& other);

// Counts invalid samples. `count` may be called from several threads concurrently; the result does not depend on the
// order of the calls.
class InvalidSampleCounter {
 public:
  InvalidSampleCounter() = default;
  InvalidSampleCounter(const InvalidSampleCounter& other) { set(other.get()); }
  InvalidSampleCounter& operator=(const InvalidSampleCounter& other) {
    if (this != &other) set(other.get());
    return *this;
  }

  // `radiance` must be invalid, coordinates below 65536.
  void count(int x, int y, uint32_t sample, const Rgb& radiance);
  InvalidSamples get() const;
  void set(const InvalidSamples& samples);

 private:
  static constexpr uint64_t kListNotFull = std::numeric_limits<uint64_t>::max();

  std::atomic<uint64_t> nan_{0}, infinite_{0}, negative_{0};
  std::atomic<uint64_t> last_listed_{kListNotFull};  // sort key of the last list entry, once the list is full
  mutable std::mutex mutex_;
  std::vector<InvalidSample> first_;
};

}  // namespace etendue::film
