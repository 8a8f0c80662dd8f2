// The region of interest: a rectangle of the image that receives all samples (render/focus.h). It is not part of the
// document.
#pragma once
#include <optional>

#include "base/vec.h"
#include "render/render_part.h"
#include "viewer/viewport/placement.h"

namespace etendue::viewer {

struct AppState;

class FocusRegion {
 public:
  // Whether the next drag in the image selects the region.
  bool is_selecting() const { return is_selecting_; }
  void begin_selection() { is_selecting_ = true; }
  void cancel_selection() { is_selecting_ = false; }
  // Positions of a drag in the window. The region is the part of the image between them; a drag that is not larger than
  // a click selects nothing.
  void drag(const AppState& state, Vec2 from, Vec2 to);
  void end_drag();

  bool exists() const { return region_.has_value(); }
  void clear() { *this = {}; }
  // The pixels of the image; nothing if there is no region.
  std::optional<render::PixelRect> pixels(Vec2i image_size) const;

  // Called once per frame: passes the region on to the session.
  void update(const AppState& state) const;
  // The rectangle, and its error beside it.
  void draw(AppState& state) const;

 private:
  bool is_selecting_ = false;
  // Relative to the image, so that the region stays where it is when the image changes its size.
  std::optional<Placement> region_, dragged_;
};

// Selects a region with the next drag; clears the region if there is one.
void toggle_focus_region(AppState& state);

}  // namespace etendue::viewer
