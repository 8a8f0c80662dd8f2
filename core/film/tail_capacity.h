// How many deviations an accumulator of tails keeps.
#pragma once
#include <cstddef>

namespace etendue::film {

// The number of the largest deviations that are kept when the memory is full. Reports use no more, so that they do not
// depend on when that happens.
constexpr size_t kept_deviations(size_t capacity) { return capacity * 3 / 4; }

}  // namespace etendue::film
