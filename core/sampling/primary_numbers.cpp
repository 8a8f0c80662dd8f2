#include "sampling/primary_numbers.h"

#include <bit>
#include <cmath>

#include "base/hash.h"

namespace etendue {
namespace {

// 2^x for x in (-126, 0], off by a ten-thousandth: sizes of steps need no more.
float power_of_two(float x) {
  const float whole = std::floor(x), f = x - whole;
  const float fraction = 1 + f * (0.6951f + f * (0.2262f + f * 0.0787f));
  return fraction * std::bit_cast<float>((static_cast<int32_t>(whole) + 127) << 23);
}

void draw_anew(uint32_t key, SampleBlock& out) {
  for (uint32_t k = 0; k < kBlockSize; ++k) out[k] = to_unit_float(mix_bits(key + k * 0x9e3779b9U));
}

void move(uint32_t key, float most, float log_ratio, SampleBlock& out) {
  for (uint32_t k = 0; k < kBlockSize; ++k) {
    const uint32_t bits = mix_bits(key + k * 0x9e3779b9U);
    const float size = most * power_of_two(log_ratio * to_unit_float(bits));
    const float moved = out[k] + ((bits & 1U) != 0 ? size : -size);
    const float wrapped = moved - std::floor(moved);
    out[k] = wrapped < 1 ? wrapped : 0.0f;
  }
}

}  // namespace

PrimaryProposals::PrimaryProposals() {
  for (size_t stream = 0; stream < PrimaryPoints::kStreams; ++stream) views_.emplace_back(*this, stream);
}

void PrimaryProposals::propose(size_t lane, uint64_t key, bool large) {
  Proposal& p = proposals_[lane];
  p = {key, p.number + 1, large};
}

const SampleBlock& PrimaryProposals::block(size_t lane, size_t stream, uint32_t block) {
  auto& blocks = streams_[stream];
  while (blocks.size() <= block) blocks.push_back(std::make_unique<Block>());
  Block& b = *blocks[block];
  const uint32_t number = proposals_[lane].number;
  if (b.numbers[lane] != number) {
    draw(lane, stream, block, b.values[lane]);
    b.numbers[lane] = number;
  }
  return b.values[lane];
}

void PrimaryProposals::draw(size_t lane, size_t stream, uint32_t block, SampleBlock& out) const {
  // After so many steps nothing of a number is left: what it would be matters to nobody.
  constexpr uint32_t kForgotten = 64;
  const Proposal& p = proposals_[lane];
  const uint64_t place = (static_cast<uint64_t>(stream) << 32 | block) + 1;
  const auto key = static_cast<uint32_t>(mix_bits(p.key ^ place * 0x9e3779b97f4a7c15ULL) >> 32);
  const PrimaryPoints::Clock& clock = from_->clocks[lane];
  const auto& known = from_->streams[stream];
  const uint32_t time = block < known.size() ? known[block].times[lane] : 0;
  if (p.large || time < clock.renewed || clock.now - time > kForgotten) return draw_anew(key, out);
  out = known[block].values[lane];
  const float log_ratio = std::log2(size_.least / size_.most);
  for (uint32_t step = 0; step <= clock.now - time; ++step) move(key + step * 0x85ebca6bU, size_.most, log_ratio, out);
}

void PrimaryProposals::accept(size_t lane, PrimaryPoints& to) {
  const Proposal& p = proposals_[lane];
  PrimaryPoints::Clock& clock = to.clocks[lane];
  ++clock.now;
  if (p.large) clock.renewed = clock.now;
  for (size_t stream = 0; stream < PrimaryPoints::kStreams; ++stream) {
    const auto& blocks = streams_[stream];
    auto& known = to.streams[stream];
    for (size_t i = 0; i < blocks.size(); ++i) {
      if (blocks[i]->numbers[lane] != p.number) continue;
      if (known.size() <= i) known.resize(i + 1);
      known[i].values[lane] = blocks[i]->values[lane];
      known[i].times[lane] = clock.now;
    }
  }
}

void PrimaryProposals::View::block(uint32_t seed, uint32_t, uint32_t block, SampleBlock& out) const {
  out = proposals_->block(seed & kLaneBits, stream_, block);
}

DimensionSet PrimaryProposals::View::blocks(std::span<const uint32_t> seeds, uint32_t, uint32_t block, DimensionSet,
                                            SampleTable& out) const {
  for (size_t i = 0; i < seeds.size(); ++i) {
    const SampleBlock& values = proposals_->block(seeds[i] & kLaneBits, stream_, block);
    for (size_t k = 0; k < kBlockSize; ++k) out.values[k][i] = values[k];
  }
  return dimensions(0, kBlockSize);
}

}  // namespace etendue
