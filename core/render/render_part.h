// The part of a rendering that one process computes, so that several processes can share the work.
#pragma once
#include <cstdint>
#include <optional>

namespace etendue::render {

struct PixelRect {
  int x = 0, y = 0, width = 0, height = 0;  // from the upper left corner

  int right() const { return x + width; }
  int bottom() const { return y + height; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

struct RenderPart {
  uint32_t first_sample = 0;        // the limits count samples from here
  std::optional<PixelRect> region;  // the pixels that are rendered; nothing: all

  bool is_whole() const { return first_sample == 0 && !region; }
  friend bool operator==(const RenderPart&, const RenderPart&) = default;
};

}  // namespace etendue::render
