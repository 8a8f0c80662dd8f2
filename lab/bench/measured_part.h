// Results of some repeats of a benchmark as the content of a part (job_part/part_file.h).
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bench/benchmark.h"

namespace etendue::bench {

struct MeasuredPart {
  Reference reference;  // without the display (set_display)
  int threads = 0;
  PartOutcome outcome;
};

std::vector<std::byte> bytes_of(const MeasuredPart& part);
// Nothing if the bytes are damaged, or not of this number of methods and of images of this size.
std::optional<MeasuredPart> measured_part_from(std::span<const std::byte> bytes, size_t methods, int width, int height);

// A hash of the pixels of a reference.
uint64_t hash_of(const Reference& reference);

}  // namespace etendue::bench
