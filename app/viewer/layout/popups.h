// Windows over the viewport: the progress of opening a file, and notices.
#pragma once

namespace etendue::viewer {

struct AppState;

void draw_loading(AppState& state);
void draw_notices(AppState& state);

}  // namespace etendue::viewer
