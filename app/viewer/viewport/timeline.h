// Playing animations: the clock, and the bar with the time over the lower edge of the image.
#pragma once

namespace etendue::viewer {

struct AppState;

struct Playback {
  bool is_playing = false;
  int frames_per_second = 24;  // of steps by the keyboard
  double waiting = 0;     // seconds since the last step of the time
  float bar_height = 0;   // of the bar on screen, pixels; 0 if there is none
};

// Whether the scene has animations.
bool is_animated(const AppState& state);
void toggle_playback(AppState& state);
// Moves the time forward by the seconds that have passed, as soon as the image of the last step is on screen. Playing
// does not count as an edit of the scene.
void advance_playback(AppState& state, float seconds);
// Moves the time to another frame; after the last frame follows the first one.
void step_frame(AppState& state, int step);
void draw_timeline(AppState& state);

}  // namespace etendue::viewer
