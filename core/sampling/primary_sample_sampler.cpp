#include "sampling/primary_sample_sampler.h"

#include <bit>
#include <cmath>

#include "base/hash.h"
#include "base/vectorize.h"

namespace etendue {
namespace {

// 2^x for x in (-126, 0] with a relative error of 1e-4, which is sufficient for step sizes.
float power_of_two(float x) {
  const auto up = static_cast<int32_t>(x);
  const int32_t whole = up - (static_cast<float>(up) > x ? 1 : 0);
  const float f = x - static_cast<float>(whole);
  const float fraction = 1 + f * (0.6951f + f * (0.2262f + f * 0.0787f));
  return fraction * std::bit_cast<float>((whole + 127) << 23);
}

// The random bits of coordinate k of a block with this key.
constexpr uint32_t coordinate_bits(uint32_t key, uint32_t k) { return mix_bits(key + k * 0x9e3779b9U); }

// x after a small step with the sign and the size that the random bits determine.
float small_step(float x, uint32_t bits, const StepRange& range) {
  const float size = range.max * power_of_two(range.log_ratio * to_unit_float(bits));
  const float moved = x + ((bits & 1U) != 0 ? size : -size);
  const float wrapped = moved < 0 ? moved + 1 : moved >= 1 ? moved - 1 : moved;
  return wrapped < 1 ? wrapped : 0.0f;
}

}  // namespace

// The computation of one block of a proposal. Either all values are new, or they are the values of `from` after the
// proposed small step and `missed` accepted steps. Both are computed and one is selected, because a branch would be
// mispredicted.
struct PrimarySampleProposals::BlockUpdate {
  const SampleBlock* from;
  SampleBlock* to;
  uint32_t key, missed;
  bool resample;

  ETENDUE_VECTORIZE static void apply(std::span<const BlockUpdate> updates, const StepRange& range) {
    for (const BlockUpdate& u : updates) {
      SampleBlock values;
      for (uint32_t k = 0; k < kBlockSize; ++k) {
        const uint32_t bits = coordinate_bits(u.key, k);
        values[k] = select(u.resample, to_unit_float(bits), small_step((*u.from)[k], bits, range));
      }
      for (uint32_t step = 1; step <= u.missed; ++step)
        for (uint32_t k = 0; k < kBlockSize; ++k)
          values[k] = small_step(values[k], coordinate_bits(u.key + step * 0x85ebca6bU, k), range);
      *u.to = values;
    }
  }
};

PrimarySampleProposals::PrimarySampleProposals() {
  for (size_t stream = 0; stream < PrimarySamplePoints::kStreams; ++stream) samplers_.emplace_back(*this, stream);
}

void PrimarySampleProposals::begin(const PrimarySamplePoints& points, const StepSize& size, Stopwatch* stopwatch) {
  points_ = &points;
  stopwatch_ = stopwatch;
  range_ = {.max = size.max, .log_ratio = std::log2(size.min / size.max)};
}

void PrimarySampleProposals::propose(size_t lane, uint64_t key, bool large) {
  Proposal& p = proposals_[lane];
  p.key = key;
  p.large = large;
  p.used_blocks = {};
  ++p.number;
}

const PrimarySampleProposals::Block& PrimarySampleProposals::blocks(std::span<const uint32_t> seeds, size_t stream,
                                                                    uint32_t block) {
  const Stopwatch::Lap lap(stopwatch_);
  auto& blocks = streams_[stream];
  while (blocks.size() <= block) blocks.push_back(std::make_unique<Block>());
  Block& b = *blocks[block];
  const auto& current_blocks = points_->streams[stream];
  const PrimarySamplePoints::Block* current = block < current_blocks.size() ? &current_blocks[block] : nullptr;
  const uint64_t block_key = ((static_cast<uint64_t>(stream) << 32 | block) + 1) * 0x9e3779b97f4a7c15ULL;
  std::array<BlockUpdate, PrimarySamplePoints::kLanes> updates;
  size_t count = 0;
  for (const uint32_t seed : seeds) {
    const size_t lane = seed & kLaneMask;
    Proposal& p = proposals_[lane];
    if (b.numbers[lane] == p.number) continue;
    b.numbers[lane] = p.number;
    p.used_blocks[stream] = std::max(p.used_blocks[stream], block + 1);
    BlockUpdate& update = updates[count++];
    update.to = &b.values[lane];
    update.key = static_cast<uint32_t>(mix_bits(p.key ^ block_key) >> 32);
    set_source(lane, current, update);
  }
  BlockUpdate::apply({updates.data(), count}, range_);
  return b;
}

// Sets `from`, `missed` and `resample`; `current` is the block in the current points, null if it was never used.
void PrimarySampleProposals::set_source(size_t lane, const PrimarySamplePoints::Block* current,
                                        BlockUpdate& update) const {
  // After this number of steps, a coordinate is practically independent of its old value and is sampled anew.
  constexpr uint32_t kMaxMissed = 64;
  update.from = current ? &current->values[lane] : update.to;
  const PrimarySamplePoints::Clock& clock = points_->clocks[lane];
  const uint32_t updated = current ? current->updated[lane] : 0, missed = clock.now - updated;
  update.resample = proposals_[lane].large | (updated < clock.last_large_step) | (missed > kMaxMissed);
  update.missed = update.resample ? 0 : missed;
}

void PrimarySampleProposals::accept(size_t lane, PrimarySamplePoints& to) {
  const Proposal& p = proposals_[lane];
  PrimarySamplePoints::Clock& clock = to.clocks[lane];
  ++clock.now;
  if (p.large) clock.last_large_step = clock.now;
  for (size_t stream = 0; stream < PrimarySamplePoints::kStreams; ++stream) {
    const auto& proposed = streams_[stream];
    auto& current = to.streams[stream];
    if (current.size() < p.used_blocks[stream]) current.resize(p.used_blocks[stream]);
    for (size_t i = 0; i < p.used_blocks[stream]; ++i) {
      if (proposed[i]->numbers[lane] != p.number) continue;
      current[i].values[lane] = proposed[i]->values[lane];
      current[i].updated[lane] = clock.now;
    }
  }
}

void PrimarySampleProposals::StreamSampler::block(uint32_t seed, uint32_t, uint32_t block, SampleBlock& out) const {
  out = proposals_->blocks({&seed, 1}, stream_, block).values[seed & kLaneMask];
}

DimensionSet PrimarySampleProposals::StreamSampler::blocks(std::span<const uint32_t> seeds, uint32_t, uint32_t block,
                                                           DimensionSet, SampleTable& out) const {
  const Block& proposed = proposals_->blocks(seeds, stream_, block);
  for (size_t i = 0; i < seeds.size(); ++i) {
    const SampleBlock& values = proposed.values[seeds[i] & kLaneMask];
    for (size_t k = 0; k < kBlockSize; ++k) out.values[k][i] = values[k];
  }
  return dimensions(0, kBlockSize);
}

}  // namespace etendue
