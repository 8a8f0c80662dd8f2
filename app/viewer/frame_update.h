// The update of the application state before each frame: results of background work are taken up.
#pragma once

namespace etendue::viewer {

struct AppState;
class ImageView;

// Takes up files that were read or written, the newest image of the session, and results of background tasks. New
// images are uploaded to `live_image`.
void update_state(AppState& state, ImageView& live_image);

// Whether a background task has a result that update_state has not taken up yet.
bool has_task_update(const AppState& state);
// Whether a background task will have an update without an event.
bool has_waiting_task(const AppState& state);
// Whether a file is being read or written.
bool is_file_active(const AppState& state);

}  // namespace etendue::viewer
