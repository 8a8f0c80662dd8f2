// Where on a rendering's way its error is measured, and how: the same for a bench and for a contest.
#pragma once
#include <cstdint>
#include <span>

#include "bench/reference.h"

namespace etendue::bench {

// Every repeat of every method has a seed of its own, below those of references.
uint64_t seed_of(uint64_t seed, size_t method, int repeat);

// Errors are measured at 1, 2, 3, 4, 6, 8, 12 ... samples: powers of two, at which nets are whole, and what is half way
// between. This is the number after `count`, which is one of them or zero.
uint32_t next_count(uint32_t count);

// The error as measured: with the reference's noise in it.
metrics::ErrorPoint point_of(std::span<const float> picture, const Reference& reference, double seconds,
                             uint32_t samples);

}  // namespace etendue::bench
