// Questions about unsaved edits: before they are discarded, and after a viewer has ended unexpectedly.
#pragma once

namespace etendue::viewer {

struct AppState;

// "Save the edits of NAME?", before another file is opened or the viewer ends.
void draw_unsaved_edits_dialog(AppState& state);

// Offers the edits of viewers that ended unexpectedly.
void draw_recovery_dialog(AppState& state);

}  // namespace etendue::viewer
