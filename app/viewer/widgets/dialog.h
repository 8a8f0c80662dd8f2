// Modal dialogs in the middle of the window.
#pragma once
#include <imgui.h>

namespace etendue::viewer {

struct AppState;

// Opens the dialog if it is closed, and begins it. It is as large as its content if `size` is zero. Returns whether to
// draw the content, which ends with ImGui::EndPopup. Escape does not close it.
bool begin_dialog(const char* name, const ImVec2& size = {0, 0});

// A button that scripts find as `item`.
bool dialog_button(AppState& state, const char* label, const char* item);

// Whether Escape is pressed for the current dialog: a list or menu that is open above it comes first.
bool escape_is_pressed();

}  // namespace etendue::viewer
