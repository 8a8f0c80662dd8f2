#include "sampling/primary_sample_sampler.h"

#include <bit>
#include <cmath>

#include "base/hash.h"
#include "base/vectorize.h"

namespace etendue {
namespace {

// 2^x for x in (-126, 0], off by a ten-thousandth: sizes of steps need no more.
float power_of_two(float x) {
  const auto up = static_cast<int32_t>(x);
  const int32_t whole = up - (static_cast<float>(up) > x ? 1 : 0);
  const float f = x - static_cast<float>(whole);
  const float fraction = 1 + f * (0.6951f + f * (0.2262f + f * 0.0787f));
  return fraction * std::bit_cast<float>((whole + 127) << 23);
}

// The key of one number of a block.
constexpr uint32_t bits_of(uint32_t key, uint32_t k) { return mix_bits(key + k * 0x9e3779b9U); }

// Where a move that these bits decide leads from x.
float moved(float x, uint32_t bits, const StepRange& range) {
  const float size = range.most * power_of_two(range.log_ratio * to_unit_float(bits));
  const float to = x + ((bits & 1U) != 0 ? size : -size);
  const float wrapped = to < 0 ? to + 1 : to >= 1 ? to - 1 : to;
  return wrapped < 1 ? wrapped : 0.0f;
}

}  // namespace

// What becomes of one block: all numbers are drawn anew, or they catch up on steps that they missed, and move once
// more. Which of both is decided without a branch: nothing foretells it.
struct PrimarySampleProposals::Draw {
  const SampleBlock* from;
  SampleBlock* to;
  uint32_t key, missed;
  bool anew;

  ETENDUE_VECTORIZE static void all(std::span<const Draw> draws, const StepRange& range) {
    for (const Draw& d : draws) {
      SampleBlock values;
      for (uint32_t k = 0; k < kBlockSize; ++k) {
        const uint32_t bits = bits_of(d.key, k);
        values[k] = select(d.anew, to_unit_float(bits), moved((*d.from)[k], bits, range));
      }
      for (uint32_t step = 1; step <= d.missed; ++step)
        for (uint32_t k = 0; k < kBlockSize; ++k)
          values[k] = moved(values[k], bits_of(d.key + step * 0x85ebca6bU, k), range);
      *d.to = values;
    }
  }
};

PrimarySampleProposals::PrimarySampleProposals() {
  for (size_t stream = 0; stream < PrimarySamplePoints::kStreams; ++stream) views_.emplace_back(*this, stream);
}

void PrimarySampleProposals::begin(const PrimarySamplePoints& from, const StepSize& size, Stopwatch* watch) {
  from_ = &from, watch_ = watch;
  range_ = {size.most, std::log2(size.least / size.most)};
}

void PrimarySampleProposals::propose(size_t lane, uint64_t key, bool large) {
  Proposal& p = proposals_[lane];
  p.key = key, p.large = large, p.asked = {};
  ++p.number;
}

const PrimarySampleProposals::Block& PrimarySampleProposals::blocks(std::span<const uint32_t> seeds, size_t stream,
                                                                    uint32_t block) {
  const Stopwatch::Lap lap(watch_);
  auto& blocks = streams_[stream];
  while (blocks.size() <= block) blocks.push_back(std::make_unique<Block>());
  Block& b = *blocks[block];
  const auto& known = from_->streams[stream];
  const PrimarySamplePoints::Block* before = block < known.size() ? &known[block] : nullptr;
  const uint64_t place = ((static_cast<uint64_t>(stream) << 32 | block) + 1) * 0x9e3779b97f4a7c15ULL;
  std::array<Draw, PrimarySamplePoints::kLanes> draws;
  size_t count = 0;
  for (const uint32_t seed : seeds) {
    const size_t lane = seed & kLaneMask;
    Proposal& p = proposals_[lane];
    if (b.numbers[lane] == p.number) continue;
    b.numbers[lane] = p.number;
    p.asked[stream] = std::max(p.asked[stream], block + 1);
    Draw& draw = draws[count++];
    draw.to = &b.values[lane], draw.key = static_cast<uint32_t>(mix_bits(p.key ^ place) >> 32);
    find_past(lane, before, draw);
  }
  Draw::all({draws.data(), count}, range_);
  return b;
}

// What a draw starts from.
void PrimarySampleProposals::find_past(size_t lane, const PrimarySamplePoints::Block* before, Draw& draw) const {
  // After so many steps nothing of a number is left: what it would be matters to nobody.
  constexpr uint32_t kForgotten = 64;
  draw.from = before ? &before->values[lane] : draw.to;
  const PrimarySamplePoints::Clock& clock = from_->clocks[lane];
  const uint32_t time = before ? before->times[lane] : 0, missed = clock.now - time;
  draw.anew = proposals_[lane].large | (time < clock.renewed) | (missed > kForgotten);
  draw.missed = draw.anew ? 0 : missed;
}

void PrimarySampleProposals::accept(size_t lane, PrimarySamplePoints& to) {
  const Proposal& p = proposals_[lane];
  PrimarySamplePoints::Clock& clock = to.clocks[lane];
  ++clock.now;
  if (p.large) clock.renewed = clock.now;
  for (size_t stream = 0; stream < PrimarySamplePoints::kStreams; ++stream) {
    const auto& blocks = streams_[stream];
    auto& known = to.streams[stream];
    if (known.size() < p.asked[stream]) known.resize(p.asked[stream]);
    for (size_t i = 0; i < p.asked[stream]; ++i) {
      if (blocks[i]->numbers[lane] != p.number) continue;
      known[i].values[lane] = blocks[i]->values[lane];
      known[i].times[lane] = clock.now;
    }
  }
}

void PrimarySampleProposals::View::block(uint32_t seed, uint32_t, uint32_t block, SampleBlock& out) const {
  out = proposals_->blocks({&seed, 1}, stream_, block).values[seed & kLaneMask];
}

DimensionSet PrimarySampleProposals::View::blocks(std::span<const uint32_t> seeds, uint32_t, uint32_t block,
                                                  DimensionSet, SampleTable& out) const {
  const Block& drawn = proposals_->blocks(seeds, stream_, block);
  for (size_t i = 0; i < seeds.size(); ++i) {
    const SampleBlock& values = drawn.values[seeds[i] & kLaneMask];
    for (size_t k = 0; k < kBlockSize; ++k) out.values[k][i] = values[k];
  }
  return dimensions(0, kBlockSize);
}

}  // namespace etendue
