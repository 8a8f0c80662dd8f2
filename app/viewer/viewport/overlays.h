// Everything that is drawn over the image: the selection, markers, scales and labels.
#pragma once

namespace etendue::viewer {

struct AppState;

void draw_viewport_overlays(AppState& state);

}  // namespace etendue::viewer
