#include "sampling/random.h"

#include "base/hash.h"

namespace etendue {

void RandomSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  // A good mixer over a counter, with a state of 64 bits: two values from each.
  uint64_t state = (uint64_t{pixel_seed} << 32 | sample) * 0x9e3779b97f4a7c15ULL + uint64_t{block} * 0xd1342543de82ef95ULL;
  for (size_t i = 0; i < out.size(); i += 2) {
    state += 0x9e3779b97f4a7c15ULL;
    const uint64_t bits = mix_bits(state);
    out[i] = to_unit_float(static_cast<uint32_t>(bits));
    out[i + 1] = to_unit_float(static_cast<uint32_t>(bits >> 32));
  }
}

}  // namespace etendue
