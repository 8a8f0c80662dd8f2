#include "sampling/sampler.h"

namespace etendue {

DimensionSet Sampler::blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block, DimensionSet,
                             SampleTable& out) const {
  SampleBlock values;
  for (size_t i = 0; i < pixel_seeds.size(); ++i) {
    this->block(pixel_seeds[i], sample, block, values);
    for (size_t k = 0; k < values.size(); ++k) out.values[k][i] = values[k];
  }
  return dimensions(0, kBlockSize);
}

}  // namespace etendue
