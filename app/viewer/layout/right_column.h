// The right column with its tabs, and the splitter to its left.
#pragma once

namespace etendue::viewer {

struct AppState;

// Draws the column between two vertical positions. Returns the x coordinate of its left side.
float draw_right_column(AppState& state, float top, float bottom);

}  // namespace etendue::viewer
