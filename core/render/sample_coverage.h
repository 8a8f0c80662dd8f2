// Which samples of which pixels the parts of a rendering contain.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/render_part.h"

namespace etendue::render {

// The samples [first, end) of the pixels of a rectangle.
struct SampleBox {
  uint32_t first = 0, end = 0;
  PixelRect pixels;

  friend bool operator==(const SampleBox&, const SampleBox&) = default;
};

// Whether a rectangle has pixels and lies in an image of this size.
bool is_inside(const PixelRect& rect, int width, int height);

// "samples 0:16", or "samples 0:16 of region 0,0,32,32" if the block does not have all pixels of the image.
std::string text_of(const SampleBox& block, int width, int height);

// The indices of two blocks that have a sample in common; nothing if there are none.
std::optional<std::pair<size_t, size_t>> find_overlap(std::span<const SampleBox> blocks);

// The samples below `end` that no block contains, at most `most` blocks. `blocks` must not overlap.
std::vector<SampleBox> find_gaps(std::span<const SampleBox> blocks, int width, int height, uint32_t end, size_t most);

// The same samples in ascending order, as blocks that are joined where the sample ranges of equal rectangles meet.
std::vector<SampleBox> joined(std::vector<SampleBox> blocks);

}  // namespace etendue::render
