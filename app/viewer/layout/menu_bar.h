// The main menu.
#pragma once

namespace etendue::viewer {

struct AppState;

void draw_menu_bar(AppState& state);

}  // namespace etendue::viewer
