// A window over the image that the user drags to another place.
#pragma once
#include <functional>

#include "viewer/viewport/placement.h"

namespace etendue::viewer {

class MovableWindow {
 public:
  // Draws the window with its content. `offset` is the distance in pixels from the upper right corner of `region` to that
  // of the window, to the left and down. The window stays inside the region. A drag changes `offset`, a double click
  // sets it to `usual_offset`. Returns true when a drag ends or the window is reset.
  bool draw(const char* name, const Placement& region, Vec2& offset, const Vec2& usual_offset,
            const std::function<void()>& content);

  // Of the last frame.
  const Placement& placement() const { return placement_; }

 private:
  Vec2 clamped(const Placement& region, const Vec2& offset) const;
  bool take_drag(Vec2& offset, const Vec2& usual_offset);

  Placement placement_{.corner = Vec2(0), .size = Vec2(0)};
  bool is_dragged_ = false;
};

}  // namespace etendue::viewer
