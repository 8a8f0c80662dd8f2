#include "viewer/layout/interface.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "render/document.h"
#include "viewer/layout/bottom_panel.h"
#include "viewer/layout/detached_panels.h"
#include "viewer/layout/help_window.h"
#include "viewer/layout/menu_bar.h"
#include "viewer/layout/popups.h"
#include "viewer/layout/right_column.h"
#include "viewer/layout/session_dialogs.h"
#include "viewer/layout/status_bar.h"
#include "viewer/layout/viewport_menu.h"
#include "viewer/state/app_state.h"
#include "viewer/state/object_edits.h"
#include "viewer/viewport/overlays.h"

namespace etendue::viewer {
namespace {

constexpr size_t kEscape = 256;  // GLFW_KEY_ESCAPE

// Draws everything around the viewport and returns the region that is left for it.
Placement draw_frame(AppState& state) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  if (!state.interface.visible) return {Vec2(0), glm::max(Vec2(screen.x, screen.y), Vec2(1))};
  draw_menu_bar(state);
  drop_stale_selection(state);
  const float top = ImGui::GetFrameHeight();
  const float status_top = screen.y - std::floor(ImGui::GetFontSize() + 10);
  draw_status_bar(state, status_top, screen.y - status_top);
  const float right = draw_right_column(state, top, status_top);
  const float bottom = draw_bottom_panel(state, top, right, status_top);
  draw_detached_panels(state);
  return {Vec2(0, top), glm::max(Vec2(right, bottom - top), Vec2(1))};
}

// Closes menus, lists and context menus. Dialogs, which close themselves, stay open. Dear ImGui closes popups on Escape only
// with keyboard navigation, which is off.
void close_popups() {
  const auto& popups = ImGui::GetCurrentContext()->OpenPopupStack;
  int first = popups.Size;
  while (first > 0 && !(popups[first - 1].Window && (popups[first - 1].Window->Flags & ImGuiWindowFlags_Modal)))
    --first;
  if (first < popups.Size) ImGui::ClosePopupToLevel(first, true);
}

}  // namespace

void Interface::draw(AppState& state, float seconds) {
  const Input& input = state.ui.input;
  InterfaceState& interface = state.interface;
  ViewportState& viewport = state.viewport;
  state.ui.items.begin_frame();
  state.ui.items.advance(seconds);
  interface.typing = ImGui::GetIO().WantTextInput;
  // Escape closes a popup; it is then not a shortcut.
  const bool closes_popup = interface.popup_open && input.keys_pressed[kEscape];
  const bool flying = input.buttons[static_cast<size_t>(Button::right)];  // W, A, S, D, Q and E move the camera
  interface.dialog_open = state.files.request || state.files.after_unsaved_edits ||
                          !state.files.lost_sessions.empty() || interface.preferences_open || interface.welcome_open;
  if (!interface.typing && !closes_popup && !interface.dialog_open && !flying) state.actions.run_pressed(state, input);

  drop_stale_selection(state);
  viewport.region = draw_frame(state);
  if (state.has_document()) viewport.image = placement_of(viewport.zoom, viewport.region, shown_image_size(state));
  viewport_.handle_input(state, seconds);
  advance_playback(state, seconds);
  draw_viewport_overlays(state);
  if (interface.visible) draw_timeline(state);
  draw_viewport_menu(state);
  draw_loading(state);
  draw_notices(state);
  draw_help(state);
  palette_.draw(state);
  preferences_.draw(state);
  file_dialog_.draw(state);
  welcome_.draw(state);
  draw_unsaved_edits_dialog(state);
  draw_recovery_dialog(state);
  if (closes_popup) close_popups();
  interface.popup_open =
      interface.help_open || interface.palette_open || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

}  // namespace etendue::viewer
