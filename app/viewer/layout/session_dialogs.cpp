#include "viewer/layout/session_dialogs.h"

#include <imgui.h>

#include <optional>
#include <utility>

#include "render/document.h"
#include "viewer/files/file_names.h"
#include "viewer/files/loader.h"
#include "viewer/files/session_export.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/widgets/dialog.h"

namespace etendue::viewer {
namespace {

enum class LostSessionChoice { none, recover, discard };

LostSessionChoice draw_lost_session(AppState& state, const LostSession& session) {
  auto choice = LostSessionChoice::none;
  ImGui::PushID(session.file.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(base_name(session.scene).c_str());
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", session.last_edit.c_str());
  ImGui::TableNextColumn();
  if (dialog_button(state, "Recover", "recovery.recover")) choice = LostSessionChoice::recover;
  ImGui::SameLine();
  if (dialog_button(state, "Discard", "recovery.discard")) choice = LostSessionChoice::discard;
  ImGui::PopID();
  return choice;
}

}  // namespace

void draw_unsaved_edits_dialog(AppState& state) {
  constexpr const char* kName = "##unsaved-edits";
  FileState& files = state.files;
  // While the file dialog is open or the session is being written, the question waits.
  if (!files.after_unsaved_edits || files.request || files.session_export->is_busy()) return;
  if (!begin_dialog(kName)) return;
  ImGui::Text("Save the edits of %s?", title_of(state.document(), files.session_file).c_str());
  ImGui::TextDisabled("They are lost otherwise.");
  ImGui::Spacing();
  const bool save = dialog_button(state, "Save", "unsaved.save");
  ImGui::SameLine();
  const bool discard = dialog_button(state, "Discard", "unsaved.discard");
  ImGui::SameLine();
  const bool cancel = dialog_button(state, "Cancel", "unsaved.cancel") || escape_is_pressed();
  if (save || discard || cancel) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  if (save) return state.save_session();
  if (!discard && !cancel) return;
  const auto proceed = std::exchange(files.after_unsaved_edits, nullptr);
  if (discard) proceed(state);
}

void draw_recovery_dialog(AppState& state) {
  constexpr const char* kName = "##recovery";
  auto& sessions = state.files.lost_sessions;
  if (sessions.empty() || state.files.loader->is_busy() || state.files.after_unsaved_edits) return;
  if (!begin_dialog(kName)) return;
  ImGui::TextUnformatted("\u00c9tendue ended unexpectedly. These scenes have unsaved edits:");
  std::optional<size_t> chosen;
  auto choice = LostSessionChoice::none;
  if (ImGui::BeginTable("##sessions", 3, ImGuiTableFlags_SizingFixedFit)) {
    for (size_t i = 0; i < sessions.size(); ++i) {
      const auto pressed = draw_lost_session(state, sessions[i]);
      if (pressed == LostSessionChoice::none) continue;
      chosen = i;
      choice = pressed;
    }
    ImGui::EndTable();
  }
  ImGui::Spacing();
  const bool later = dialog_button(state, "Decide at the next start", "recovery.later") || escape_is_pressed();
  if (later || chosen) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  if (later) return sessions.clear();
  if (!chosen) return;
  const LostSession session = sessions[*chosen];
  sessions.erase(sessions.begin() + static_cast<std::ptrdiff_t>(*chosen));
  if (choice == LostSessionChoice::discard) return EditJournal::discard(session.file);
  sessions.clear();  // one scene is open at a time; the others are offered at the next start
  state.files.loader->recover(session.file.string());
}

}  // namespace etendue::viewer
