#include "viewer/panels/library_section.h"

#include <imgui.h>

#include <algorithm>

#include "render/material_settings.h"
#include "viewer/files/file_names.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/state/material_edits.h"
#include "viewer/tasks/file_thumbnails.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/image_tooltip.h"

namespace etendue::viewer {

void LibrarySection::read_folder(const AppState& state) {
  const std::string folder = material_folder(state).string();
  std::error_code code;
  const auto time = std::filesystem::last_write_time(folder, code);
  if (folder == folder_ && time == folder_time_) return;
  folder_ = folder;
  folder_time_ = time;
  files_.clear();
  for (std::filesystem::directory_iterator entry(folder, code); !code && entry != std::filesystem::directory_iterator();
       entry.increment(code))
    if (lower_extension(entry->path().string()) == render::kMaterialExtension) files_.push_back(entry->path().string());
  std::ranges::sort(files_);
}

void LibrarySection::draw_file(AppState& state, const std::string& file, size_t index, float side) {
  const std::string item = "material.library." + std::to_string(index);
  const std::string name = std::filesystem::path(file).stem().string();
  ImGui::PushID(static_cast<int>(index));
  ImGui::BeginGroup();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton("##file", {side, side});
  state.ui.items.add(item);
  const ImVec2 end(corner.x + side, corner.y + side);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ThumbnailImage* image = state.tasks.thumbnails->find(file);
  const ImTextureID texture = image ? thumbnails_.texture(state.platform.gl(), index, *image) : nullptr;
  if (image)
    draw.AddImage(texture, corner, end);
  else
    draw.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg));
  if (ImGui::IsItemHovered()) {
    const std::string text = name + "\nA click gives the selected material these parameters. Right click: more";
    draw.AddRect(corner, end, ImGui::GetColorU32(state.ui.theme.accent), 0, 0, 2);
    image_tooltip(state.ui, texture, image ? *image : ThumbnailImage(), text);
  }
  if (ImGui::BeginPopupContextItem("##menu")) {
    if (ImGui::MenuItem("Add as new material")) add_material_from_file(state, file);
    state.ui.items.add(item + ".add");
    if (ImGui::MenuItem("Copy file name")) state.platform.set_clipboard(file);
    ImGui::EndPopup();
  }
  ImGui::TextUnformatted(shortened(name, side).c_str());
  ImGui::EndGroup();
  ImGui::PopID();
  if (clicked) apply_material_file(state, file);
}

void LibrarySection::draw(AppState& state) {
  read_folder(state);
  action_button(state, "material.save");
  if (files_.empty()) return note(state.ui, "No material files in " + folder_);
  constexpr int kColumns = 4;
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const float side = (ImGui::GetContentRegionAvail().x - (kColumns - 1) * spacing) / kColumns;
  for (size_t i = 0; i < files_.size(); ++i) {
    if (i % kColumns != 0) ImGui::SameLine();
    draw_file(state, files_[i], i, side);
  }
}

}  // namespace etendue::viewer
