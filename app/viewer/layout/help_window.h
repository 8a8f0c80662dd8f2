// The list of common shortcuts.
#pragma once

namespace etendue::viewer {

struct AppState;

// Draws the list while InterfaceState::help_open is set.
void draw_help(AppState& state);

}  // namespace etendue::viewer
