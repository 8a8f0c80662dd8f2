#include "viewer/layout/welcome_dialog.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "scene/builtin/builtin.h"
#include "viewer/files/file_names.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/tasks/file_thumbnails.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/dialog.h"

namespace etendue::viewer {
namespace {

constexpr float kAspect = 0.5625f;  // height / width of an image
constexpr size_t kMaxRecent = 6;

// An image of this width with its label below, or an empty frame while there is no image. Returns whether it was clicked.
bool draw_scene(const ThumbnailImage* image, ImTextureID texture, const char* label, float width) {
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size(width, width * kAspect);
  const bool clicked = ImGui::InvisibleButton(label, {size.x, size.y + line});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 end(corner.x + size.x, corner.y + size.y);
  draw->AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg));
  if (image) {
    // The image fills the frame; what does not fit is cut.
    const float aspect = static_cast<float>(image->height) / static_cast<float>(image->width);
    const float u = std::max(0.0f, 0.5f - 0.5f * aspect / kAspect), v = std::max(0.0f, 0.5f - 0.5f * kAspect / aspect);
    draw->AddImage(texture, corner, end, {u, v}, {1 - u, 1 - v});
  }
  if (ImGui::IsItemHovered()) draw->AddRect(corner, end, ImGui::GetColorU32(ImGuiCol_CheckMark), 0, 0, 2);
  draw->AddText({corner.x, end.y + 2}, ImGui::GetColorU32(ImGuiCol_Text), label);
  return clicked;
}

}  // namespace

bool WelcomeDialog::draw_builtin_scenes(AppState& state) {
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const float available = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, static_cast<int>(available / (ImGui::GetFontSize() * 10)));
  const float width = (available - spacing * static_cast<float>(columns - 1)) / static_cast<float>(columns);
  const auto& scenes = scene::builtins();
  const scene::Builtin* chosen = nullptr;
  for (size_t i = 0; i < scenes.size(); ++i) {
    if (i % static_cast<size_t>(columns) != 0) ImGui::SameLine();
    const ThumbnailImage* image = state.tasks.thumbnails->find(scenes[i].name);
    const ImTextureID texture = image ? textures_.texture(state.platform.gl(), i, *image) : nullptr;
    if (draw_scene(image, texture, scenes[i].label, width)) chosen = &scenes[i];
    state.ui.items.add(std::string("welcome.") + scenes[i].name);
    if (ImGui::IsItemHovered()) tooltip(state.ui, scenes[i].doc);
  }
  if (chosen) state.open_file(chosen->name);
  return chosen != nullptr;
}

void WelcomeDialog::find_recent_files(const AppState& state) {
  recent_.clear();
  std::error_code code;
  for (const std::string& file : state.settings.recent)
    if (recent_.size() < kMaxRecent && !scene::find_builtin(file) && std::filesystem::exists(file, code))
      recent_.push_back(file);
}

bool WelcomeDialog::draw_recent_files(AppState& state) {
  std::string chosen;
  for (const std::string& file : recent_) {
    if (ImGui::Selectable(base_name(file).c_str())) chosen = file;
    if (ImGui::IsItemHovered()) tooltip(state.ui, file);
  }
  if (recent_.empty()) note(state.ui, "Files that you open are listed here. You can also drop a file on the window.");
  if (!chosen.empty()) state.open_file(chosen);
  return !chosen.empty();
}

void WelcomeDialog::draw(AppState& state) {
  bool& open = state.interface.welcome_open;
  // Questions about unsaved edits and the file dialog come first.
  if (!open) is_open_ = false;
  if (!open || !state.files.lost_sessions.empty() || state.files.request || state.files.after_unsaved_edits) return;
  if (!std::exchange(is_open_, true)) find_recent_files(state);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  if (!begin_dialog("##welcome", {std::min(screen.x * 0.94f, em * 52), std::min(screen.y * 0.9f, em * 34)})) return;
  ImGui::TextColored(state.ui.theme.accent, "\u00c9tendue");
  ImGui::SameLine();
  ImGui::TextDisabled("Path tracing and light transport on the CPU");
  ImGui::Spacing();
  const float footer = ImGui::GetFrameHeightWithSpacing();
  const float side_width = em * 14;
  ImGui::BeginChild("##scenes", {-side_width - em, -footer});
  ImGui::TextDisabled("Built-in scenes");
  bool closed = draw_builtin_scenes(state);
  ImGui::EndChild();
  ImGui::SameLine(0, em);
  ImGui::BeginChild("##recent", {0, -footer});
  ImGui::TextDisabled("Recent files");
  closed = draw_recent_files(state) || closed;
  ImGui::Spacing();
  action_button(state, "file.open");
  ImGui::EndChild();
  if (ImGui::Button("Close") || escape_is_pressed()) closed = true;
  state.ui.items.add("welcome.close");
  ImGui::SameLine();
  if (ImGui::Checkbox("Show at the start", &state.settings.show_welcome)) state.store_settings();
  state.ui.items.add("welcome.show");
  if (closed) {
    open = false;
    state.tasks.thumbnails->cancel_waiting();
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace etendue::viewer
