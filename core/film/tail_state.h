// The state of tail statistics in a form that can be stored and merged in any order.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace etendue::film {

// Equal sets of deviations have equal states, however they were merged.
struct TailState {
  uint64_t samples = 0;
  // Exact sums as expansions (base/error_free.h): of samples, of squared deviations and of their fourth powers.
  std::vector<double> sum, squares, fourths;
  float threshold = 0;         // the largest deviation that is not stored; 0 if all positive ones are
  std::vector<float> largest;  // descending; at most three quarters of the capacity (film/tail_capacity.h)

  friend bool operator==(const TailState&, const TailState&) = default;
};

// Adds `other`. Both are of accumulators of this capacity.
void merge(TailState& state, const TailState& other, size_t capacity);

// A list of states as bytes, and back. Nothing if the bytes are damaged.
std::vector<std::byte> bytes_of(std::span<const TailState> states);
std::optional<std::vector<TailState>> tail_states_from(std::span<const std::byte> bytes);

}  // namespace etendue::film
