#include "sampling/stratified.h"

#include "sampling/point_group.h"

namespace etendue {

void StratifiedSampler::block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const {
  const auto n = static_cast<uint32_t>(side.value), cells = n * n;
  const GroupMember member = group_member(pixel_seed, sample, block, cells);
  const auto jitter = [&](uint32_t i) {
    return to_unit_float(hash_combine(member.seed, member.index * kBlockSize + i));
  };
  // Dimensions 0-1 and 2-3 of every block are two-dimensional decisions.
  for (uint32_t i = 0; i < 4; i += 2) {
    const uint32_t cell = permutation_element(member.index, cells, mix_bits(member.seed + i + 1));
    out[i] = jittered(cell % n, n, jitter(i));
    out[i + 1] = jittered(cell / n, n, jitter(i + 1));
  }
  for (uint32_t i = 4; i < kBlockSize; ++i) out[i] = jittered_interval(member, i, cells);
}

}  // namespace etendue
