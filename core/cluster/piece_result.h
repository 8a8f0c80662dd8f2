// The samples of a piece, and their form as a message.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cluster/work_schedule.h"
#include "render/partial_result.h"

namespace etendue::cluster {

struct PieceResult {
  Piece piece;
  render::PartialSamples samples;
  uint64_t rays = 0, paths = 0;
};

// Adds the samples of `from` to `to`, exactly. Both are of images of the same size.
void add_samples(render::PartialSamples& to, const render::PartialSamples& from);

// A message with a checksum.
std::vector<std::byte> bytes_of(const PieceResult& result);
// Nothing if the bytes are damaged, or if they are not of an image of this size.
std::optional<PieceResult> piece_result_from(std::span<const std::byte> bytes, int width, int height);

}  // namespace etendue::cluster
