// The sample points of one pixel.
#pragma once
#include <cstdint>
#include <vector>

#include "sampling/sampler.h"

namespace etendue::test {

// points[sample][dimension] for the first `count` samples and `blocks` blocks.
inline std::vector<std::vector<float>> points(const Sampler& sampler, uint32_t seed, uint32_t count, uint32_t blocks) {
  std::vector<std::vector<float>> all(count);
  for (uint32_t s = 0; s < count; ++s)
    for (uint32_t b = 0; b < blocks; ++b) {
      SampleBlock values;
      sampler.block(seed, s, b, values);
      all[s].insert(all[s].end(), values.begin(), values.end());
    }
  return all;
}

}  // namespace etendue::test
