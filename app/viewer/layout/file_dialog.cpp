#include "viewer/layout/file_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

#include "viewer/state/app_state.h"

namespace etendue::viewer {
namespace fs = std::filesystem;

void FileDialog::ask(std::string title, std::string folder, std::vector<std::string> extensions, bool saves,
                     std::string name, std::function<void(const std::string&)> chosen) {
  title_ = std::move(title);
  extensions_ = std::move(extensions);
  saves_ = saves;
  chosen_ = std::move(chosen);
  open_ = appearing_ = true;
  std::error_code code;
  enter(folder.empty() || !fs::is_directory(folder, code) ? fs::current_path(code) : fs::path(folder));
  name_ = std::move(name);
}

void FileDialog::enter(const fs::path& folder) {
  folder_ = folder.lexically_normal();
  if (!saves_) name_.clear();
  read_folder();
}

void FileDialog::read_folder() {
  folders_.clear();
  files_.clear();
  problem_.clear();
  std::error_code code;
  for (fs::directory_iterator it(folder_, fs::directory_options::skip_permission_denied, code), end; !code && it != end;
       it.increment(code)) {
    const std::string name = it->path().filename().string();
    if (name.starts_with('.')) continue;
    std::error_code kind;
    if (it->is_directory(kind)) {
      folders_.push_back(name);
      continue;
    }
    std::string extension = it->path().extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (std::find(extensions_.begin(), extensions_.end(), extension) != extensions_.end()) files_.push_back(name);
  }
  if (code) problem_ = folder_.string() + ": " + code.message();
  std::sort(folders_.begin(), folders_.end());
  std::sort(files_.begin(), files_.end());
}

void FileDialog::draw(Workbench& w) {
  if (!open_) return;
  if (appearing_) ImGui::OpenPopup("##files");
  appearing_ = false;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float line = ImGui::GetFrameHeightWithSpacing();
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(screen.x * 0.9f, line * 24), std::min(screen.y * 0.85f, line * 19)});
  if (!ImGui::BeginPopupModal("##files", &open_,
                              ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove))
    return;
  bool accepted = false;
  ImGui::TextUnformatted(title_.c_str());
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", folder_.c_str());
  ImGui::PopTextWrapPos();
  ImGui::BeginChild("##list", {0, -2 * line - ImGui::GetStyle().ItemSpacing.y}, true);
  fs::path go_to;
  if (folder_.has_parent_path() && ImGui::Selectable("../", false)) go_to = folder_.parent_path();
  for (const auto& name : folders_)
    if (ImGui::Selectable((name + "/").c_str())) go_to = folder_ / name;
  for (const auto& name : files_) {
    if (ImGui::Selectable(name.c_str(), name == name_, ImGuiSelectableFlags_AllowDoubleClick)) {
      name_ = name;
      accepted = ImGui::IsMouseDoubleClicked(0);
    }
    w.items.place("files." + name);
  }
  if (files_.empty()) ImGui::TextDisabled("No file here that could be used");
  ImGui::EndChild();
  if (!go_to.empty()) enter(go_to);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::InputTextWithHint("##name", "name or path", &name_, ImGuiInputTextFlags_EnterReturnsTrue)) accepted = true;
  w.items.place("files.name");
  if (const auto name = w.items.take("files.name")) name_ = *name, w.items.answer("");
  if (ImGui::Button(saves_ ? "Save" : "Open") && !name_.empty()) accepted = true;
  w.items.place("files.accept");
  ImGui::SameLine();
  if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) open_ = false;
  w.items.place("files.cancel");
  if (!problem_.empty()) ImGui::SameLine(), ImGui::TextColored(w.theme.warning, "%s", problem_.c_str());
  if (accepted && !name_.empty()) {
    const fs::path path = fs::path(name_).is_absolute() ? fs::path(name_) : folder_ / name_;
    std::error_code code;
    if (fs::is_directory(path, code)) {
      enter(path);
    } else if (!saves_ && !fs::exists(path, code)) {
      problem_ = "There is no such file";
    } else {
      w.settings.folder = path.parent_path().string();
      open_ = false;
      chosen_(path.string());
    }
  }
  if (!open_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace etendue::viewer
