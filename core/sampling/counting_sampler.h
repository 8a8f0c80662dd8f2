// A sampler that counts which dimensions of another one are drawn.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sampling/sampler.h"

namespace etendue {

// How often each dimension was drawn, by block.
class DimensionCounts {
 public:
  // Later blocks are not counted.
  static constexpr uint32_t kBlocks = 32;

  // Each dimension of a sample counts once, also if several paths of the sample draw it.
  void begin_sample() { drawn_.fill(0); }
  void add(uint32_t block, DimensionSet drawn);
  uint32_t at(uint32_t block, int dimension) const {
    return block < kBlocks ? counts_[block][static_cast<size_t>(dimension)] : 0;
  }

  friend bool operator==(const DimensionCounts&, const DimensionCounts&) = default;

 private:
  std::array<std::array<uint32_t, kBlockSize>, kBlocks> counts_{};
  std::array<DimensionSet, kBlocks> drawn_{};  // in the current sample
};

// Counts the dimensions that are requested from `sampler`. For one thread.
class CountingSampler final : public Sampler {
 public:
  CountingSampler(const Sampler& sampler, DimensionCounts& counts) : sampler_(sampler), counts_(counts) {}

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    counts_.add(block, dimensions(0, kBlockSize));
    sampler_.block(pixel_seed, sample, block, out);
  }
  DimensionSet blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block, DimensionSet requested,
                      SampleTable& out) const override {
    if (!pixel_seeds.empty()) counts_.add(block, requested);
    return sampler_.blocks(pixel_seeds, sample, block, requested, out);
  }
  uint32_t lane_mask() const override { return sampler_.lane_mask(); }
  int tile_bits() const override { return sampler_.tile_bits(); }

 private:
  const Sampler& sampler_;
  DimensionCounts& counts_;
};

}  // namespace etendue
