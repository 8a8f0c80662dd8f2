// The random numbers of Markov chains: points of the unit cube of all numbers that a path may ask for.
//                                                     Kelemen, Szirmay-Kalos, Antal, Csonka 2002
//
// A proposal is a point that is either drawn anew (a large step) or moved a little in every number. A number's move has
// either sign and a size between `least` and `most`, whose logarithm is uniform; the cube is closed to a torus. Numbers
// that nobody asks for cost nothing: each block knows when it was last looked at, and catches up on the steps in
// between.
//
// What is drawn follows from the proposal's key and the number's place, in whatever order numbers are asked for.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/stopwatch.h"
#include "sampling/sampler.h"

namespace etendue {

struct StepSize {
  float least = 1.0f / 1024, most = 1.0f / 64;
};

// The same as moves take it: sizes are most * 2^(log_ratio u).
struct StepRange {
  float most = 0, log_ratio = 0;
};

// Where chains are, side by side.
class PrimarySamplePoints {
 public:
  static constexpr size_t kLanes = 256;
  // Sequences of blocks that each chain has: one for each end of a path, and one for what belongs to both.
  static constexpr size_t kStreams = 3;

  // A block of all chains.
  struct Block {
    std::array<SampleBlock, kLanes> values;
    std::array<uint32_t, kLanes> times{};  // when each was last looked at; zero: never
  };

  // In steps that were taken. A block that is older than `renewed` is not defined any more.
  struct Clock {
    uint32_t now = 0, renewed = 1;
  };
  std::array<Clock, kLanes> clocks;
  std::array<std::vector<Block>, kStreams> streams;

  size_t memory() const {
    size_t bytes = 0;
    for (const auto& blocks : streams) bytes += blocks.capacity() * sizeof(Block);
    return bytes;
  }
};

// Proposals of all chains: what they ask for is drawn as they ask. Seeds that walks are given tell the chain in their
// lower bits.
class PrimarySampleProposals {
 public:
  static constexpr uint32_t kLaneMask = PrimarySamplePoints::kLanes - 1;

  PrimarySampleProposals();

  // From now on proposals are made from these points, which have to stay where they are; the watch runs while numbers
  // are drawn.
  void begin(const PrimarySamplePoints& from, const StepSize& size, Stopwatch* watch = nullptr);
  // The next proposal of a chain.
  void propose(size_t lane, uint64_t key, bool large);
  // The chain goes there.
  void accept(size_t lane, PrimarySamplePoints& to);

  struct Block {
    std::array<SampleBlock, PrimarySamplePoints::kLanes> values;
    std::array<uint32_t, PrimarySamplePoints::kLanes> numbers{};  // of the proposals that they belong to
  };
  // One block of the chains that the seeds tell: at most as many as there are lanes, each once.
  const Block& blocks(std::span<const uint32_t> seeds, size_t stream, uint32_t block);
  const Sampler& sampler(size_t stream) const { return views_[stream]; }

 private:
  class View final : public Sampler {
   public:
    View(PrimarySampleProposals& proposals, size_t stream) : proposals_(&proposals), stream_(stream) {}
    void block(uint32_t seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
    DimensionSet blocks(std::span<const uint32_t> seeds, uint32_t sample, uint32_t block, DimensionSet wanted,
                        SampleTable& out) const override;
    uint32_t lane_mask() const override { return kLaneMask; }

   private:
    PrimarySampleProposals* proposals_;
    size_t stream_;
  };
  struct Proposal {
    uint64_t key = 0;
    uint32_t number = 0;  // counts the proposals of the lane
    bool large = false;
    std::array<uint32_t, PrimarySamplePoints::kStreams> asked{};  // one more than the last block that was asked for
  };
  struct Draw;

  void find_past(size_t lane, const PrimarySamplePoints::Block* before, Draw& draw) const;

  const PrimarySamplePoints* from_ = nullptr;
  StepRange range_;
  Stopwatch* watch_ = nullptr;
  std::array<Proposal, PrimarySamplePoints::kLanes> proposals_;
  std::array<std::vector<std::unique_ptr<Block>>, PrimarySamplePoints::kStreams> streams_;
  std::vector<View> views_;
};

}  // namespace etendue
