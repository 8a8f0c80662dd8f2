// Rectangles of the window and the image that is shown in one.
#pragma once
#include "base/vec.h"

namespace etendue::viewer {

// A rectangle of the window, in pixels from the upper left corner.
struct Placement {
  Vec2 corner{0};
  Vec2 size{1};

  bool contains(Vec2 p) const {
    return p.x >= corner.x && p.y >= corner.y && p.x < corner.x + size.x && p.y < corner.y + size.y;
  }
};

// The part that two rectangles share; empty if there is none.
inline Placement intersection(const Placement& a, const Placement& b) {
  const Vec2 corner = glm::max(a.corner, b.corner);
  return {corner, glm::max(glm::min(a.corner + a.size, b.corner + b.size) - corner, Vec2(0))};
}

// The largest rectangle in the centre of `region` that has the aspect ratio of an image of this size, in whole pixels.
inline Placement fit_inside(const Placement& region, Vec2i image_size) {
  const Vec2 size = glm::max(Vec2(image_size), Vec2(1));
  const float scale = std::min(region.size.x / size.x, region.size.y / size.y);
  const Vec2 shown = glm::max(glm::round(size * scale), Vec2(1));
  return {glm::floor(region.corner + (region.size - shown) * 0.5f), shown};
}

// The pixel of an image that is shown at a position of the window, clamped to the image. `image` is the rectangle that
// the image fills, `image_size` its number of pixels.
inline Vec2i pixel_at(const Placement& image, Vec2i image_size, Vec2 position) {
  const Vec2 relative = (position - image.corner) / image.size;
  return glm::clamp(Vec2i(glm::floor(relative * Vec2(image_size))), Vec2i(0), image_size - 1);
}

}  // namespace etendue::viewer
