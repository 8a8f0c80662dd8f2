// Random numbers of Markov chains in primary sample space                                  [Kelemen et al. 2002]
//
// A point of primary sample space is the sequence of all random numbers of a path. A proposal is either a new,
// independent point (large step), or the current point with every coordinate moved by a small step. A step has a random
// sign and a size between `min` and `max` whose logarithm is uniform. Coordinates wrap around at 0 and 1.
//
// Coordinates are computed on demand. Each block of coordinates stores the time of its last update, and when it is used
// again, the accepted small steps since then are applied to it. A coordinate depends on the key of the proposal and on
// its own index only, never on the order in which coordinates are requested.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/stopwatch.h"
#include "sampling/sampler.h"

namespace etendue {

struct StepSize {
  float min = 1.0f / 1024, max = 1.0f / 64;
};

// A step has the size max * 2^(log_ratio u) for uniform u; log_ratio is log2(min / max).
struct StepRange {
  float max = 0, log_ratio = 0;
};

// The current points of up to kLanes chains.
class PrimarySamplePoints {
 public:
  static constexpr size_t kLanes = 256;
  // Sequences of blocks of each chain: the camera subpath, the light subpath, and decisions that concern both.
  static constexpr size_t kStreams = 3;

  // One block of all chains.
  struct Block {
    std::array<SampleBlock, kLanes> values;
    std::array<uint32_t, kLanes> updated{};  // the time of the last update; 0 if there was none
  };

  // The time of a chain counts its accepted proposals.
  struct Clock {
    uint32_t now = 0;
    uint32_t last_large_step = 1;  // blocks that were updated before this time are undefined
  };
  std::array<Clock, kLanes> clocks;
  std::array<std::vector<Block>, kStreams> streams;

  // In bytes, of the blocks.
  size_t memory() const {
    size_t bytes = 0;
    for (const auto& blocks : streams) bytes += blocks.capacity() * sizeof(Block);
    return bytes;
  }
};

// Proposals for all chains. The lower bits of a pixel seed (kLaneMask) are the lane of the chain.
class PrimarySampleProposals {
 public:
  static constexpr uint32_t kLaneMask = PrimarySamplePoints::kLanes - 1;

  PrimarySampleProposals();

  // Following proposals start from these points, which must outlive them. `stopwatch` (may be null) measures the time
  // spent on coordinates.
  void begin(const PrimarySamplePoints& points, const StepSize& size, Stopwatch* stopwatch = nullptr);
  // Starts the next proposal of a chain.
  void propose(size_t lane, uint64_t key, bool large);
  // Makes the proposal of a chain its current point in `to`.
  void accept(size_t lane, PrimarySamplePoints& to);

  struct Block {
    std::array<SampleBlock, PrimarySamplePoints::kLanes> values;
    std::array<uint32_t, PrimarySamplePoints::kLanes> numbers{};  // of the proposals to which the values belong
  };
  // A block of the proposals of the chains in `seeds`, each at most once.
  const Block& blocks(std::span<const uint32_t> seeds, size_t stream, uint32_t block);
  // The proposals as a sampler.
  const Sampler& sampler(size_t stream) const { return samplers_[stream]; }

 private:
  class StreamSampler final : public Sampler {
   public:
    StreamSampler(PrimarySampleProposals& proposals, size_t stream) : proposals_(&proposals), stream_(stream) {}
    void block(uint32_t seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
    DimensionSet blocks(std::span<const uint32_t> seeds, uint32_t sample, uint32_t block, DimensionSet requested,
                        SampleTable& out) const override;
    uint32_t lane_mask() const override { return kLaneMask; }

   private:
    PrimarySampleProposals* proposals_;
    size_t stream_;
  };
  struct Proposal {
    uint64_t key = 0;
    uint32_t number = 0;  // counts the proposals of the chain
    bool large = false;
    std::array<uint32_t, PrimarySamplePoints::kStreams> used_blocks{};  // upper bound of the indices, exclusive
  };
  struct BlockUpdate;

  void set_source(size_t lane, const PrimarySamplePoints::Block* current, BlockUpdate& update) const;

  const PrimarySamplePoints* points_ = nullptr;
  StepRange range_;
  Stopwatch* stopwatch_ = nullptr;
  std::array<Proposal, PrimarySamplePoints::kLanes> proposals_;
  std::array<std::vector<std::unique_ptr<Block>>, PrimarySamplePoints::kStreams> streams_;
  std::vector<StreamSampler> samplers_;
};

}  // namespace etendue
