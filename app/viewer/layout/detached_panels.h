// Panels in windows of their own, over the image.
#pragma once

namespace etendue::viewer {

struct AppState;
class Panel;

// Draws the windows. Closing one returns the panel to its tab.
void draw_detached_panels(AppState& state);

// The context menu of the tab that was drawn last.
void tab_menu(AppState& state, Panel& panel);

}  // namespace etendue::viewer
