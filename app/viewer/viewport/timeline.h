// Playing animations: the clock, and the bar with the time over the lower edge of the image.
#pragma once

namespace etendue::viewer {

struct AppState;

struct Playback {
  bool is_playing = false;
  double waiting = 0;     // seconds since the last step of the time
  float bar_height = 0;   // of the bar on screen, pixels; 0 if there is none
};

// Whether the scene has animations.
bool is_animated(const AppState& state);
void toggle_playback(AppState& state);
// Moves the time forward by the seconds that have passed, as soon as the image of the last step is on screen. Playing
// does not count as an edit of the scene.
void advance_playback(AppState& state, float seconds);
void draw_timeline(AppState& state);

}  // namespace etendue::viewer
