#include "viewer/layout/bottom_panel.h"

#include <imgui.h>

#include <cmath>

#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollbar;

float strip_height() { return std::floor(ImGui::GetFontSize() + 10); }

void begin_window(const char* name, const ImVec2& corner, const ImVec2& size, const ImVec2& padding) {
  ImGui::SetNextWindowPos(corner);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin(name, nullptr, kFixed);
}

void end_window() {
  ImGui::End();
  ImGui::PopStyleVar(2);
}

void draw_tab(Workbench& w, const SheetInfo& info) {
  const bool open = w.view.sheet == info.name;
  ImGui::PushStyleColor(ImGuiCol_Text, open ? w.theme.accent : w.theme.quiet);
  const bool clicked = ImGui::Selectable(info.label, open, 0, {ImGui::CalcTextSize(info.label).x, 0});
  ImGui::PopStyleColor();
  w.items.place(info.name);
  if (ImGui::IsItemHovered()) tooltip(w, info.doc);
  if (clicked) w.view.sheet = open ? "" : info.name;
}

// The tabs; an edge that can be dragged where a sheet is open.
void draw_strip(Workbench& w, float top, float right, float bottom, bool open) {
  begin_window("##drawer-tabs", {0, top}, {right, strip_height()}, {10, 5});
  for (const SheetInfo& info : sheets()) {
    if (&info != &sheets().front()) ImGui::SameLine(0, ImGui::GetFontSize() * 1.4f);
    draw_tab(w, info);
  }
  if (open) {
    const float free = right - 10 - ImGui::GetItemRectMax().x - ImGui::GetFontSize();
    ImGui::SameLine(0, ImGui::GetFontSize());
    ImGui::InvisibleButton("##edge", {std::max(1.0f, free), ImGui::GetFontSize()});
    w.items.place("layout.drawer");
    const bool held = ImGui::IsItemActive(), over = ImGui::IsItemHovered();
    if (held || over) {
      ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
      ImGui::GetWindowDrawList()->AddLine({0, top + 1}, {right, top + 1}, ImGui::GetColorU32(w.theme.accent), 2);
    }
    if (held) w.settings.drawer = (bottom - w.input.mouse.y) / w.platform.scale();
    if (over && ImGui::IsMouseDoubleClicked(0)) w.settings.drawer = 0;
  }
  end_window();
}

}  // namespace

const std::vector<SheetInfo>& sheets() {
  static const std::vector<SheetInfo> list{
      {"sheet.convergence", "Convergence", "Methods take turns on this scene; their errors grow as curves",
       draw_convergence_sheet},
      {"sheet.health", "Health", "How far the picture can be trusted: its error, its rarest samples, what was rejected",
       draw_health_sheet},
      {"sheet.paths", "Paths",
       "Where the energy of this view comes from, by classes of light paths, and what the method finds of it",
       draw_paths_sheet},
      {"sheet.techniques", "Techniques", "What each technique of a bidirectional method adds to the picture",
       draw_techniques_sheet},
      {"sheet.sampling", "Sampling",
       "The samples of one pixel: their running mean, their histogram, the points they are made of",
       draw_sampling_sheet},
      {"sheet.surface", "Surface", "What the chosen material does with light: its lobe, its energy, its samples",
       draw_surface_sheet},
  };
  return list;
}

void with_controls(Workbench& w, float width, const std::function<void()>& shown, void (*controls)(Workbench&)) {
  const float room = ImGui::GetContentRegionAvail().x, gap = ImGui::GetFontSize();
  const bool wide = room > 3 * width;
  if (wide) ImGui::BeginChild("##shown", {std::floor(room - width - gap), 0});
  ImGui::PushFont(w.faces.small);
  shown();
  ImGui::PopFont();
  if (!wide) return controls(w);
  ImGui::EndChild();
  ImGui::SameLine(0, gap);
  ImGui::BeginChild("##controls");
  controls(w);
  ImGui::EndChild();
}

float draw_drawer(Workbench& w, float top, float right, float bottom) {
  const float scale = w.platform.scale(), strip = strip_height(), room = bottom - top;
  const auto open =
      std::find_if(sheets().begin(), sheets().end(), [&](const SheetInfo& info) { return w.view.sheet == info.name; });
  if (open == sheets().end()) {
    draw_strip(w, bottom - strip, right, bottom, false);
    return strip;
  }
  const float wanted = w.settings.drawer > 0 ? w.settings.drawer * scale : room * 0.36f;
  const float height = std::floor(std::clamp(wanted, std::min(120 * scale, room * 0.5f), room * 0.75f));
  draw_strip(w, bottom - height, right, bottom, true);
  begin_window("##drawer", {0, bottom - height + strip}, {right, height - strip}, {10, 6});
  ImGui::BeginChild("##sheet");
  if (w.editor.empty())
    note(w, "No scene is open.");
  else
    open->draw(w);
  ImGui::EndChild();
  end_window();
  return height;
}

}  // namespace etendue::viewer
