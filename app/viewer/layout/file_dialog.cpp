#include "viewer/layout/file_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "viewer/files/file_names.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/dialog.h"

namespace etendue::viewer {
namespace fs = std::filesystem;

void FileDialog::open(const AppState& state) {
  const FileRequest& request = *state.files.request;
  const fs::path folder = state.settings.folder;
  std::error_code code;
  saves_ = request.saves;
  extensions_ = request.extensions;
  enter_folder(fs::is_directory(folder, code) ? folder : fs::current_path(code));
  name_ = request.name;
  is_open_ = true;
}

void FileDialog::enter_folder(const fs::path& folder) {
  folder_ = folder.lexically_normal();
  if (!saves_) name_.clear();
  read_folder();
}

void FileDialog::read_folder() {
  folders_.clear();
  files_.clear();
  problem_.clear();
  std::error_code code;
  fs::directory_iterator entry(folder_, fs::directory_options::skip_permission_denied, code);
  for (; !code && entry != fs::directory_iterator(); entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with('.')) continue;
    std::error_code ignored;
    if (entry->is_directory(ignored))
      folders_.push_back(name);
    else if (std::ranges::find(extensions_, lower_extension(name)) != extensions_.end())
      files_.push_back(name);
  }
  if (code) problem_ = folder_.string() + ": " + code.message();
  std::ranges::sort(folders_);
  std::ranges::sort(files_);
}

bool FileDialog::draw_list(AppState& state) {
  bool accepted = false;
  fs::path target;
  if (folder_.has_parent_path() && ImGui::Selectable("../", false)) target = folder_.parent_path();
  for (const auto& name : folders_)
    if (ImGui::Selectable((name + "/").c_str())) target = folder_ / name;
  for (const auto& name : files_) {
    if (ImGui::Selectable(name.c_str(), name == name_, ImGuiSelectableFlags_AllowDoubleClick)) {
      name_ = name;
      accepted = ImGui::IsMouseDoubleClicked(0);
    }
    state.ui.items.add("files." + name);
  }
  if (files_.empty()) ImGui::TextDisabled("No suitable files in this folder");
  if (!target.empty()) enter_folder(target);
  return accepted;
}

void FileDialog::draw(AppState& state) {
  if (!state.files.request) return;
  if (!is_open_) open(state);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float line = ImGui::GetFrameHeightWithSpacing();
  if (!begin_dialog("##files", {std::min(screen.x * 0.9f, line * 24), std::min(screen.y * 0.85f, line * 19)})) return;
  UiContext& ui = state.ui;
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(state.files.request->title.c_str());
  ImGui::TextDisabled("%s", folder_.c_str());
  ImGui::PopTextWrapPos();
  ImGui::BeginChild("##list", {0, -2 * line - ImGui::GetStyle().ItemSpacing.y}, true);
  bool accepted = draw_list(state);
  ImGui::EndChild();
  ImGui::SetNextItemWidth(-1);
  if (ImGui::InputTextWithHint("##name", "File name or path", &name_, ImGuiInputTextFlags_EnterReturnsTrue))
    accepted = true;
  ui.items.add("files.name");
  if (const auto name = ui.items.take_request("files.name")) {
    name_ = *name;
    ui.items.answer("");
  }
  if (ImGui::Button(saves_ ? "Save" : "Open")) accepted = true;
  ui.items.add("files.accept");
  ImGui::SameLine();
  bool closed = ImGui::Button("Cancel") || escape_is_pressed();
  ui.items.add("files.cancel");
  if (!problem_.empty()) {
    ImGui::SameLine();
    ImGui::TextColored(ui.theme.warning, "%s", problem_.c_str());
  }
  std::function<void(const std::string&)> callback;
  std::string path;
  if (!closed && accepted && !name_.empty() && accept(state)) {
    closed = true;
    callback = std::move(state.files.request->accept);
    path = (fs::path(name_).is_absolute() ? fs::path(name_) : folder_ / name_).string();
  }
  if (closed) {
    is_open_ = false;
    state.files.request.reset();
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  // The callback may request another file.
  if (callback) callback(path);
}

bool FileDialog::accept(AppState& state) {
  const fs::path path = fs::path(name_).is_absolute() ? fs::path(name_) : folder_ / name_;
  std::error_code code;
  if (fs::is_directory(path, code)) {
    enter_folder(path);
    return false;
  }
  if (!saves_ && !fs::exists(path, code)) {
    problem_ = "File not found";
    return false;
  }
  state.settings.folder = path.parent_path().string();
  return true;
}

}  // namespace etendue::viewer
