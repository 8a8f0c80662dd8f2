// When and how the error of a rendering is measured; shared by `run` and the live benchmark.
#pragma once
#include <cstdint>
#include <span>

#include "bench/reference.h"

namespace etendue::bench {

// The seed of one repeat of one method. It is below the seeds of references.
uint64_t repeat_seed(uint64_t seed, size_t method, int repeat);

// Errors are measured at 1, 2, 3, 4, 6, 8, 12 ... samples per pixel: powers of two, at which digital nets are complete,
// and the counts half way between. Returns the count after `count`, which is one of them or zero.
uint32_t next_sample_count(uint32_t count);

// The error as measured, including the noise of the reference.
metrics::ErrorPoint measure_error(std::span<const float> image, const Reference& reference, double seconds,
                                  uint32_t samples);

}  // namespace etendue::bench
