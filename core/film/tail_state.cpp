#include "film/tail_state.h"

#include <algorithm>
#include <functional>

#include "base/error_free.h"
#include "base/state_bytes.h"
#include "film/tail_capacity.h"

namespace etendue::film {
namespace {

void add_sum(std::vector<double>& sum, const std::vector<double>& other) {
  std::vector<double> terms = sum;
  terms.insert(terms.end(), other.begin(), other.end());
  sum = expansion_of(std::move(terms));
}

}  // namespace

void merge(TailState& state, const TailState& other, size_t capacity) {
  state.samples += other.samples;
  add_sum(state.sum, other.sum);
  add_sum(state.squares, other.squares);
  add_sum(state.fourths, other.fourths);
  state.threshold = std::max(state.threshold, other.threshold);
  auto& largest = state.largest;
  largest.insert(largest.end(), other.largest.begin(), other.largest.end());
  std::ranges::sort(largest, std::greater<>());
  const size_t kept = kept_deviations(capacity);
  if (largest.size() <= kept) return;
  state.threshold = std::max(state.threshold, largest[kept]);
  largest.resize(kept);
}

std::vector<std::byte> bytes_of(std::span<const TailState> states) {
  StateWriter out;
  out.value<uint64_t>(states.size());
  for (const TailState& state : states) {
    out.value(state.samples);
    for (const auto* sum : {&state.sum, &state.squares, &state.fourths}) out.list(std::span(*sum));
    out.value(state.threshold);
    out.list(std::span(state.largest));
  }
  return out.take();
}

std::optional<std::vector<TailState>> tail_states_from(std::span<const std::byte> bytes) {
  StateReader in(bytes);
  uint64_t count = 0;
  if (!in.value(count)) return std::nullopt;
  std::vector<TailState> states;
  for (uint64_t i = 0; i < count; ++i) {
    TailState& state = states.emplace_back();
    if (!in.value(state.samples) || !in.list(state.sum) || !in.list(state.squares) || !in.list(state.fourths) ||
        !in.value(state.threshold) || !in.list(state.largest))
      return std::nullopt;
  }
  return in.at_end() ? std::optional(std::move(states)) : std::nullopt;
}

}  // namespace etendue::film
