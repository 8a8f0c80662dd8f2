// The right column with its tabs, and the splitter to its left.
#pragma once
#include <string>

namespace etendue::viewer {

class Panel;
struct AppState;

// Draws the column between two vertical positions. Returns the x coordinate of its left side.
float draw_right_column(AppState& state, float top, float bottom);

// A panel of the column with the filter of its parameters and objects, which scripts find as `item`.
void draw_column_panel(AppState& state, Panel& panel, const std::string& item, std::string& filter);

}  // namespace etendue::viewer
