// The context menu of the viewport: what can be done with the object and the point under the pointer.
#pragma once

namespace etendue::viewer {

struct AppState;

// Opens the menu if InterfaceState::menu_position was set, and draws it while it is open.
void draw_viewport_menu(AppState& state);

}  // namespace etendue::viewer
