// The share of a job that one process does, for jobs that consist of independent units: cases, figures or repeats.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/result.h"

namespace etendue::job_part {

struct Share {
  uint32_t part = 1, parts = 1;  // part 1 to `parts`

  // Units of different cost: every `parts`-th.
  bool has(size_t unit) const { return unit % parts == part - 1; }
  // Consecutive units: those from `first` to `end` - 1.
  struct Range {
    size_t first, end;
  };
  Range range(size_t units) const { return {units * (part - 1) / parts, units * part / parts}; }

  bool operator==(const Share&) const = default;
};

// 1 <= part <= parts, and not more parts than a job can have.
bool is_valid(const Share& share);
// The share in a text "K/N" with 1 <= K <= N.
Result<Share> parse_share(const std::string& text);
std::string text_of(const Share& share);  // "part 2 of 8"

}  // namespace etendue::job_part
