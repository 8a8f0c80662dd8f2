// The status bar: progress, speed, memory and error of the rendering.
#pragma once

namespace etendue::viewer {

struct AppState;

void draw_status_bar(AppState& state, float top, float height);

}  // namespace etendue::viewer
