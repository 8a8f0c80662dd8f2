#include "sampling/random.h"

#include "base/hash.h"

namespace etendue {
namespace {

constexpr uint64_t kStep = 0x9e3779b97f4a7c15;  // 2^64 / golden ratio

}  // namespace

void RandomSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  // One SplitMix64 stream per pixel and sample [Steele et al. 2014]. The initial state is a hash of both: states that
  // differ by multiples of kStep would give the next sample the same numbers, shifted.
  uint64_t state = mix_bits((uint64_t{pixel_seed} << 32 | sample) + kStep) + kStep * (kBlockSize / 2) * block;
  for (size_t i = 0; i < out.size(); i += 2) {
    state += kStep;
    const uint64_t bits = mix_bits(state);
    out[i] = to_unit_float(static_cast<uint32_t>(bits));
    out[i + 1] = to_unit_float(static_cast<uint32_t>(bits >> 32));
  }
}

}  // namespace etendue
