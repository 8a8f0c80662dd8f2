// Playing animations: the clock, and the bar with the time over the lower edge of the image.
#pragma once
#include <cstdint>
#include <optional>

#include "render/image_sequence.h"

namespace etendue::viewer {

struct AppState;

struct Playback {
  bool is_playing = false;
  int frames_per_second = 24;          // of steps by the keyboard, and of the range
  std::optional<int64_t> first, last;  // the range that is played, frames; empty: from the start, to the end
  double waiting = 0;                  // seconds since the last step of the time
  float bar_height = 0;                // of the bar on screen, pixels; 0 if there is none
};

// Whether the scene has animations.
bool is_animated(const AppState& state);
void toggle_playback(AppState& state);
// Moves the time forward by the seconds that have passed, as soon as the image of the last step is on screen. Playing
// does not count as an edit of the scene.
void advance_playback(AppState& state, float seconds);
// Moves the time to another frame of the range; after the last frame follows the first one.
void step_frame(AppState& state, int step);
// The frames that are played. At least one, also for a scene without animations.
render::FrameRange playback_range(const AppState& state);
// The present frame becomes the first or the last one of the range.
void start_range_here(AppState& state);
void end_range_here(AppState& state);
void draw_timeline(AppState& state);

}  // namespace etendue::viewer
