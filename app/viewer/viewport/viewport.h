// Pointer and keyboard input over the image: camera movements, selection, and clicks for tools.
#pragma once
#include <chrono>

#include "base/vec.h"
#include "viewer/platform/input.h"
#include "viewer/viewport/comparison_overlay.h"

namespace etendue::viewer {

struct AppState;

class ViewportController {
 public:
  // Called once per frame; `seconds` is the time since the last frame.
  void handle_input(AppState& state, float seconds);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Drag { none, orbit, pan, fly, move_image, region, environment };

  void begin_drag(AppState& state);
  void continue_drag(AppState& state);
  void fly(AppState& state, float seconds);
  // Turns the environment about the vertical axis: once for a drag over the width of the image.
  static void turn_environment(AppState& state, float movement);
  void end_drag(AppState& state);
  void click(AppState& state, Vec2 position);
  void scroll(AppState& state);
  void zoom_image(AppState& state);

  Drag drag_ = Drag::none;
  Vec2 drag_start_{0};
  Vec2 last_position_{0};
  Button button_ = Button::left;  // that began the drag
  bool moved_ = false;  // since the start of the drag; otherwise it is a click
  Vec2 click_position_{-1e6f};
  Clock::time_point click_time_{};
  Clock::time_point scroll_time_{};
  DividerControl divider_;
};

// Sets the focus distance to that of the surface at a position, and the centre of orbits to that point. Returns false
// if there is no surface.
bool focus_at(AppState& state, Vec2 position);
// Selects the node and the material at a position of the window; clears the selected node if there is no surface.
void select_at(AppState& state, Vec2 position);
// Adds the object at a position to the selection, or removes it.
void extend_selection_at(AppState& state, Vec2 position);

// Moves the camera so that it shows the whole scene, or the selected node. If walls hide the light in the direction of
// view, the scene is shown from another side or from inside.
void frame_scene(AppState& state);
void frame_selection(AppState& state);
// Uses the camera of the opened file again, or a view of the scene in which there is something to see.
void reset_view(AppState& state);

}  // namespace etendue::viewer
