// Sample variance of each tile, for adaptive sampling
//
// The mean and the variance of the samples of a tile are recorded for each half-buffer when it has 4, 8, 16, ...
// samples in every pixel. A decision based on a record depends on a fixed number of samples only, not on how many
// samples were taken afterwards, which other decisions may have determined.
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
  // Records are made at 2^power samples for powers in [kFirstPower, kEndPower).
  static constexpr int kFirstPower = 2, kEndPower = 20;

  // Means over the pixels of a tile in one half-buffer.
  struct Moments {
    float variance = 0, mean = 0;  // of the luminance of one sample
    bool known = false;
  };

  TileVariance() = default;
  explicit TileVariance(size_t tiles) : tiles_(tiles) {}

  size_t blocks() const { return tiles_.size(); }

  // Adds one sample in every pixel of a tile: the sum of the squared luminances. Different tiles may be updated from
  // different threads.
  void add(size_t tile, uint32_t half_buffer, double sum_of_squares) {
    tiles_[tile][half_buffer].squares += sum_of_squares;
  }
  double squares(size_t tile, uint32_t half_buffer) const { return tiles_[tile][half_buffer].squares; }

  // Whether a record is made after this number of samples.
  static bool is_recorded(uint32_t samples) {
    return std::has_single_bit(samples) && samples >= 1U << kFirstPower && std::countr_zero(samples) < kEndPower;
  }
  // The record at 2^power samples in every pixel of the tile.
  void record(size_t tile, uint32_t half_buffer, int power, const Moments& moments) {
    tiles_[tile][half_buffer].records[static_cast<size_t>(power - kFirstPower)] = moments;
  }
  const Moments& recorded(size_t tile, uint32_t half_buffer, int power) const {
    return tiles_[tile][half_buffer].records[static_cast<size_t>(power - kFirstPower)];
  }

  // The complete state, for checkpoints.
  std::span<std::byte> bytes() { return std::as_writable_bytes(std::span(tiles_)); }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(tiles_)); }
  static constexpr size_t kBytesOfBlock = 2 * (sizeof(double) + sizeof(Moments) * (kEndPower - kFirstPower));

 private:
  struct HalfBuffer {
    double squares = 0;
    std::array<Moments, kEndPower - kFirstPower> records;
  };
  using Tile = std::array<HalfBuffer, 2>;
  static_assert(sizeof(Tile) == kBytesOfBlock);

  std::vector<Tile> tiles_;
};

}  // namespace etendue::film
