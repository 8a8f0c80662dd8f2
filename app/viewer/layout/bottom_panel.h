// The bottom panel: a line of tabs below the viewport, of which at most one is open.
#pragma once

namespace etendue::viewer {

struct AppState;

// Draws the panel at the lower side of a region from the left side of the window to `right`. Returns the y coordinate
// of its upper side.
float draw_bottom_panel(AppState& state, float top, float right, float bottom);

}  // namespace etendue::viewer
