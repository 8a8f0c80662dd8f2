// The divider between two compared images, their names, the scale of a difference, and the values of a pixel.
#pragma once

struct ImDrawList;

namespace etendue::viewer {

struct AppState;

// The divider of a wipe comparison, which the user can drag.
class DividerControl {
 public:
  // Called once per frame; `hovered` says whether the pointer is over the image. Returns true if the divider uses the
  // pointer.
  bool handle_input(AppState& state, bool hovered);

 private:
  bool held_ = false;
};

void draw_comparison_overlay(const AppState& state, ImDrawList* draw);

}  // namespace etendue::viewer
