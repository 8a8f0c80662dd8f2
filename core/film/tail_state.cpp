#include "film/tail_state.h"

#include <algorithm>
#include <cstring>
#include <functional>

#include "base/error_free.h"

namespace etendue::film {
namespace {

void add_sum(std::vector<double>& sum, const std::vector<double>& other) {
  std::vector<double> terms = sum;
  terms.insert(terms.end(), other.begin(), other.end());
  sum = expansion_of(std::move(terms));
}

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  const auto* begin = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), begin, begin + sizeof value);
}

template <class T>
void append_list(std::vector<std::byte>& bytes, const std::vector<T>& values) {
  append(bytes, static_cast<uint32_t>(values.size()));
  const auto begin = std::as_bytes(std::span(values));
  bytes.insert(bytes.end(), begin.begin(), begin.end());
}

// Reads values in the order in which they were appended. Values beyond the end are zero and clear `is_complete`.
struct ByteReader {
  std::span<const std::byte> rest;
  bool is_complete = true;

  template <class T>
  T next() {
    T value{};
    is_complete = is_complete && rest.size() >= sizeof value;
    if (!is_complete) return value;
    std::memcpy(&value, rest.data(), sizeof value);
    rest = rest.subspan(sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> next_list() {
    const auto count = next<uint32_t>();
    is_complete = is_complete && rest.size() / sizeof(T) >= count;
    std::vector<T> values(is_complete ? count : 0);
    for (T& value : values) value = next<T>();
    return values;
  }
};

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
  const size_t kept = capacity / 2;
  if (largest.size() <= kept) return;
  state.threshold = std::max(state.threshold, largest[kept]);
  largest.resize(kept);
}

std::vector<std::byte> bytes_of(std::span<const TailState> states) {
  std::vector<std::byte> bytes;
  append(bytes, static_cast<uint32_t>(states.size()));
  for (const TailState& state : states) {
    append(bytes, state.samples);
    append_list(bytes, state.sum);
    append_list(bytes, state.squares);
    append_list(bytes, state.fourths);
    append(bytes, state.threshold);
    append_list(bytes, state.largest);
  }
  return bytes;
}

std::optional<std::vector<TailState>> tail_states_from(std::span<const std::byte> bytes) {
  ByteReader reader{bytes};
  std::vector<TailState> states;
  const auto count = reader.next<uint32_t>();
  for (uint32_t i = 0; i < count && reader.is_complete; ++i) {
    TailState state;
    state.samples = reader.next<uint64_t>();
    state.sum = reader.next_list<double>();
    state.squares = reader.next_list<double>();
    state.fourths = reader.next_list<double>();
    state.threshold = reader.next<float>();
    state.largest = reader.next_list<float>();
    states.push_back(std::move(state));
  }
  return reader.is_complete && reader.rest.empty() ? std::optional(std::move(states)) : std::nullopt;
}

}  // namespace etendue::film
