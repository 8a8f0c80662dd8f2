#include "sampling/counting_sampler.h"

namespace etendue {

void DimensionCounts::add(uint32_t block, DimensionSet drawn) {
  if (block >= kBlocks) return;
  const DimensionSet added = drawn & ~drawn_[block];
  drawn_[block] |= drawn;
  for (int k = 0; k < kBlockSize; ++k) counts_[block][static_cast<size_t>(k)] += added >> k & 1U;
}

}  // namespace etendue
