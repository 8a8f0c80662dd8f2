#include "sampling/random.h"

#include "base/hash.h"

namespace etendue {
namespace {

constexpr uint64_t kStep = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio

}  // namespace

void RandomSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  // A stream of splitmix64 for every pixel and sample. The name of the stream is hashed: one that advanced in the
  // stream's own steps would hand the numbers of a sample to the next one.
  uint64_t state = mix_bits((uint64_t{pixel_seed} << 32 | sample) + kStep) + kStep * (kBlockSize / 2) * block;
  for (size_t i = 0; i < out.size(); i += 2) {
    state += kStep;
    const uint64_t bits = mix_bits(state);
    out[i] = to_unit_float(static_cast<uint32_t>(bits));
    out[i + 1] = to_unit_float(static_cast<uint32_t>(bits >> 32));
  }
}

}  // namespace etendue
