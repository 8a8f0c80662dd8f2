// Which technique of a bidirectional method finds what? Their pictures as a pyramid, each to be switched off by a
// click.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "advisor/number_text.h"
#include "integrator/bdpt/techniques.h"
#include "integrator/integrator.h"
#include "viewer/layout/bottom_panel.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

constexpr float kWidth = 96, kLeastWidth = 48;  // of a picture, at scale one

// The methods that have techniques, as the registry says.
std::string names_of_methods() {
  std::string names;
  for (const auto& info : integrator::integrator_infos())
    if (!info.techniques.empty()) names += (names.empty() ? "" : ", ") + info.label;
  return names;
}

void toggle_technique(Workbench& w, const TechniqueCell& cell) {
  const auto& method = w.editor.document().method;
  const auto& info = *integrator::find_integrator(method.integrator);
  const std::string name = info.name + "." + std::string(info.techniques.without);
  for (const auto& binding : render::bindings(w.editor.document(), info.name))
    if (binding.info.name == name) w.edit(binding, toggled(w.techniques.left_out(), cell.s, cell.t));
}

std::string figure_of(const TechniquePyramid& pyramid, const TechniqueCell& cell) {
  const std::string name = text_of("%d,%d", cell.s, cell.t);
  const auto share = pyramid.share(cell);
  return share ? name + "  " + advisor::percent(*share) : name;
}

std::string about(const TechniquePyramid& pyramid, const TechniqueCell& cell, bool off) {
  std::string text = text_of("s = %d, t = %d: ", cell.s, cell.t) + words_of(cell.s, cell.t) + "\n" +
                     text_of("Paths of %d %s.", cell.edges(), cell.edges() == 1 ? "edge" : "edges");
  if (const auto share = pyramid.share(cell))
    text += " " + advisor::percent(*share) + " of all light, +- " +
            advisor::percent(cell.standard_error / pyramid.whole.mean) + text_of(", %u spp.", cell.samples);
  if (!off && !cell.absent.empty()) return text + "\n" + cell.absent;
  return text +
         (off ? "\nLeft out: the others do its work. Click to bring it back" : "\nClick leaves it to the others");
}

// One picture with its figure below. `off`: the method leaves it out.
void cell_of(Workbench& w, const TechniquePyramid& pyramid, size_t index, const Vec2& size, bool off) {
  const TechniqueCell& cell = pyramid.cells[index];
  const ImVec2 at = ImGui::GetCursorScreenPos(), end{at.x + size.x, at.y + size.y};
  const float line = ImGui::GetTextLineHeight();
  const bool clicked = ImGui::InvisibleButton(text_of("##%d.%d", cell.s, cell.t).c_str(), {size.x, size.y + line});
  const bool over = ImGui::IsItemHovered();
  w.items.place(text_of("techniques.cell.%d.%d", cell.s, cell.t));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, end, ImGui::GetColorU32(ImGuiCol_FrameBg, cell.absent.empty() ? 1 : 0.4f));
  if (cell.picture && !off) {
    const auto& display = w.editor.document().display;
    const GLuint texture = w.thumbnails.texture(index, {pyramid.width, pyramid.height, cell.picture,
                                                        display.exposure + w.techniques.setup.exposure, display.curve});
    draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(texture)), at, end);
  }
  if (!off && !cell.absent.empty()) {
    const ImVec2 words = ImGui::CalcTextSize("none");
    draw->AddText({at.x + (size.x - words.x) * 0.5f, at.y + (size.y - words.y) * 0.5f},
                  ImGui::GetColorU32(w.theme.quiet), "none");
  }
  if (off) {
    draw->AddLine(at, end, ImGui::GetColorU32(w.theme.warning), 1.5f);
    draw->AddLine({at.x, end.y}, {end.x, at.y}, ImGui::GetColorU32(w.theme.warning), 1.5f);
  }
  if (over) draw->AddRect(at, end, ImGui::GetColorU32(w.theme.accent), 0, 0, 2);
  const bool quiet = off || !cell.absent.empty();
  draw->AddText({at.x, end.y}, ImGui::GetColorU32(quiet ? w.theme.quiet : w.theme.text),
                (off ? figure_of(pyramid, {cell.s, cell.t, ""}) + "  off" : figure_of(pyramid, cell)).c_str());
  if (over) tooltip(w, about(pyramid, cell, off));
  if (clicked && (off || cell.absent.empty())) toggle_technique(w, cell);
}

void pyramid_of(Workbench& w, const TechniquePyramid& pyramid) {
  const float em = ImGui::GetFontSize(), label = em * 3.2f, gap = std::floor(em * 0.5f);
  const int longest = pyramid.cells.back().edges();
  const float room = (ImGui::GetContentRegionAvail().x - label) / static_cast<float>(longest + 2) - gap;
  const float wide = std::floor(std::clamp(room, kLeastWidth * w.platform.scale(), kWidth * w.platform.scale()));
  const Vec2 size(wide, std::floor(wide * static_cast<float>(pyramid.height) / static_cast<float>(pyramid.width)));
  const auto left_out = integrator::Techniques::parse(w.techniques.left_out());
  const ImVec2 corner = ImGui::GetCursorPos();
  const auto column = [&](int s) { return corner.x + label + static_cast<float>(s) * (size.x + gap); };
  for (int s = 0; s <= longest + 1; ++s) {
    ImGui::SetCursorPos({column(s), corner.y});
    ImGui::TextDisabled("s = %d", s);
    if (ImGui::IsItemHovered()) tooltip(w, text_of("%d vertices from the light, the others from the camera", s));
  }
  const float row = size.y + ImGui::GetTextLineHeight() + gap, top = corner.y + ImGui::GetTextLineHeight() + gap * 0.5f;
  for (size_t i = 0; i < pyramid.cells.size(); ++i) {
    const TechniqueCell& cell = pyramid.cells[i];
    const float y = top + row * static_cast<float>(cell.edges() - 1);
    if (cell.s == 0) {
      ImGui::SetCursorPos({corner.x, y});
      ImGui::TextDisabled("k = %d", cell.edges());
      if (ImGui::IsItemHovered()) tooltip(w, "Edges of the paths in this row");
    }
    ImGui::SetCursorPos({column(cell.s), y});
    cell_of(w, pyramid, i, size, left_out && left_out->contains(cell.s, cell.t));
  }
}

void controls(Workbench& w) {
  auto& setup = w.techniques.setup;
  const auto infos = techniques_parameters(setup);
  for (const ParameterInfo& info : infos)
    if (const auto value = loose_widget(w, info)) assign_by_name(setup.knobs(), info.name, *value);
  action_button(w, "techniques.export");
  ImGui::SameLine();
  action_button(w, "techniques.all");
  ImGui::PushFont(w.faces.small);
  if (const auto* shown = w.techniques.shown()) {
    double sum = 0;
    for (const auto& cell : shown->cells) sum += shown->share(cell).value_or(0);
    if (w.techniques.running()) note(w, "Pictures are being made, more samples round by round.");
    if (!w.techniques.fresh()) warning(w, "Of the view before the last edit.");
    note(w, "All together " + advisor::percent(sum) + " of the light" +
                (setup.weighted ? "; the rest came by longer paths."
                                : ", each path counted by every technique that finds it."));
  }
  note(w,
       "(s, t): s vertices from the light, t from the camera. Click a picture to leave its technique to the others.");
  ImGui::PopFont();
}

}  // namespace

void draw_techniques_sheet(Workbench& w) {
  if (!w.techniques.possible())
    return note(w, w.editor.document().method.integrator +
                       " has no techniques that can be shown. These have: " + names_of_methods() + ".");
  constexpr float kControls = 20;  // letters wide
  with_controls(
      w, kControls * ImGui::GetFontSize(),
      [&] {
        if (const auto* shown = w.techniques.shown())
          pyramid_of(w, *shown);
        else
          note(w, "The first pictures are being made.");
      },
      controls);
}

}  // namespace etendue::viewer
