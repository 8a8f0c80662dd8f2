// How much the samples of each block of pixels scatter: what adaptive sampling goes by.
//
// Kept for each half of the film, as seen when the half had 4, 8, 16 ... samples in every pixel: a decision that looks
// at so many first samples does not depend on how many more were taken, which another decision may have made of them.
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace etendue::film {

class TileVariance {
 public:
  static constexpr int kFirstPower = 2, kPowers = 20;  // from the first up to, not with, kPowers

  // Means over the pixels of a block, of one half.
  struct Moments {
    float variance = 0, mean = 0;  // of one sample's luminance
    bool known = false;
  };

  TileVariance() = default;
  explicit TileVariance(size_t blocks) : blocks_(blocks) {}

  size_t blocks() const { return blocks_.size(); }
  // Another sample in every pixel of a block. Different blocks may be added to from different threads.
  void add(size_t block, uint32_t half, double sum_of_squares) { of(block, half).squares += sum_of_squares; }
  double squares(size_t block, uint32_t half) const { return of(block, half).squares; }

  static bool is_recorded(uint32_t samples) {
    return std::has_single_bit(samples) && samples >= 1U << kFirstPower && std::countr_zero(samples) < kPowers;
  }
  // What was seen when the half had 2^power samples in every pixel of the block.
  void record(size_t block, uint32_t half, int power, const Moments& seen) { at(block, half, power) = seen; }
  const Moments& recorded(size_t block, uint32_t half, int power) const {
    return of(block, half).seen[static_cast<size_t>(power - kFirstPower)];
  }

  // All that it knows, for checkpoints.
  std::span<std::byte> bytes() { return std::as_writable_bytes(std::span(blocks_)); }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(blocks_)); }
  static constexpr size_t kBytesOfBlock = 2 * (sizeof(double) + sizeof(Moments) * (kPowers - kFirstPower));

 private:
  struct Half {
    double squares = 0;
    std::array<Moments, kPowers - kFirstPower> seen;
  };
  using Block = std::array<Half, 2>;
  static_assert(sizeof(Block) == kBytesOfBlock);

  Half& of(size_t block, uint32_t half) { return blocks_[block][half]; }
  const Half& of(size_t block, uint32_t half) const { return blocks_[block][half]; }
  Moments& at(size_t block, uint32_t half, int power) {
    return of(block, half).seen[static_cast<size_t>(power - kFirstPower)];
  }

  std::vector<Block> blocks_;
};

}  // namespace etendue::film
