// What does this surface do with light? Its lobe, its energy, its samples, and a ball of it; another one beside it.
#include <imgui.h>

#include <cmath>

#include "viewer/layout/bottom_panel.h"
#include "viewer/layout/interface.h"
#include "viewer/widgets/chart_painter.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/status_icon.h"

namespace etendue::viewer {
namespace {

metrics::ChartPalette palette_of(const Workbench& w) {
  metrics::ChartPalette palette;
  palette.text = ink_of(w.theme.text), palette.quiet = ink_of(w.theme.quiet);
  palette.line = palette.quiet, palette.line.opacity = 0.7;
  palette.thin_line = palette.quiet, palette.thin_line.opacity = 0.25;
  return palette;
}

bsdf_analysis::Look look_of(const Workbench& w, const Vec2& size) {
  bsdf_analysis::Look look;
  // Drawn in the units of the small face, so that strokes are as wide on every display.
  look.width = static_cast<int>(size.x / w.platform.scale()),
  look.height = static_cast<int>(size.y / w.platform.scale());
  look.palette = palette_of(w), look.length = w.surface.setup.length;
  look.turn = w.surface.turn, look.tilt = w.surface.tilt;
  return look;
}

// A pane of this size; true while the hand drags in it.
bool pane(Workbench& w, const char* name, const Vec2& size, const metrics::Drawing& drawing) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(name, {size.x, size.y});
  w.items.place(name);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
  draw(*list, drawing, corner, w.platform.scale(), w.faces.small);
  list->PopClipRect();
  return ImGui::IsItemActive();
}

std::vector<const SurfaceReading*> readings(const Workbench& w) {
  std::vector<const SurfaceReading*> list;
  for (size_t side = 0; side < 2; ++side)
    if (const auto* reading = w.surface.shown(side)) list.push_back(reading);
  return list;
}

std::vector<std::string> names_of(const std::vector<const SurfaceReading*>& list) {
  std::vector<std::string> names;
  for (const auto* reading : list) names.push_back(reading->name);
  return names;
}

void ball_pane(Workbench& w, size_t side, float edge) {
  const auto picture = w.surface.ball(side);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(side == 0 ? "surface.ball" : "surface.ball-kept", {edge, edge});
  w.items.place(side == 0 ? "surface.ball" : "surface.ball-kept");
  if (ImGui::IsItemHovered())
    tooltip(w, "A ball of this material, sample by sample, in the light that is chosen below");
  if (!picture.pixels) return;
  const GLuint texture =
      w.balls.texture(side, {picture.width, picture.height, picture.pixels, 0, image::ToneCurve::none});
  ImGui::GetWindowDrawList()->AddImage(reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(texture)), at,
                                       {at.x + edge, at.y + edge});
}

void lobe_pane(Workbench& w, size_t side, const Vec2& size) {
  const auto* reading = w.surface.shown(side);
  if (!reading) return;
  const auto drawing = bsdf_analysis::lobe_drawing(reading->lobe, reading->slice.degrees, look_of(w, size));
  const bool dragged = pane(w, side == 0 ? "surface.lobe" : "surface.lobe-kept", size, drawing);
  if (ImGui::IsItemHovered() && !dragged) tooltip(w, "f in space, for light to wo; drag to look from elsewhere");
  if (!dragged) return;
  const ImVec2 by = ImGui::GetIO().MouseDelta;
  w.surface.turn += 0.5 * static_cast<double>(by.x);
  w.surface.tilt = std::clamp(w.surface.tilt + 0.5 * static_cast<double>(by.y), -10.0, 90.0);
}

void figures(Workbench& w, const SurfaceReading& reading) {
  draw_badges(w, reading);
  figure(w, "Albedo, from everywhere", text_of("%.4f", bsdf_analysis::hemispherical_albedo(reading.audit.albedo)));
  const auto& sampling = reading.audit.sampling;
  for (const auto& q : sampling)
    if (q.degrees == 45)
      figure(w, "Noise of a sample at 45\u00b0", text_of("%.2f (cosine %.2f)", q.deviation, q.by_cosine));
}

void controls(Workbench& w) {
  auto& setup = w.surface.setup;
  for (size_t side = 0; side < 2; ++side)
    if (const auto* reading = w.surface.shown(side)) {
      ImGui::PushID(static_cast<int>(side));
      ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(color_of(metrics::ink_of_method(side))), "%s%s",
                         reading->name.c_str(), side == 1 ? " (kept)" : "");
      figures(w, *reading);
      ImGui::PopID();
    }
  for (const ParameterInfo& info : surface_parameters(setup))
    if (const auto value = loose_widget(w, info)) assign_by_name(setup.knobs(), info.name, *value);
  action_button(w, "surface.keep");
  ImGui::SameLine();
  action_button(w, "surface.drop");
}

}  // namespace

void draw_badges(Workbench& w, const SurfaceReading& reading) {
  for (const bsdf_analysis::Check& badge : reading.audit.badges) {
    traffic_light(w, badge.holds ? render::Verdict::healthy : render::Verdict::doubtful);
    ImGui::SameLine();
    ImGui::TextColored(badge.holds ? w.theme.text : w.theme.warning, "%s", badge.label());
    w.items.place(std::string("surface.badge.") + badge.name);
    if (ImGui::IsItemHovered()) tooltip(w, std::string(badge.label()) + ": " + badge.reason);
  }
}

namespace {

// Balls, lobes, slices and albedo side by side; with a second material balls and lobes are half as high.
void instruments(Workbench& w, const std::vector<const SurfaceReading*>& list) {
  const auto names = names_of(list);
  const float em = ImGui::GetFontSize(), gap = std::floor(0.5f * em), room = ImGui::GetContentRegionAvail().x;
  const float height = std::max(ImGui::GetContentRegionAvail().y, 9 * em);
  const float edge = std::floor(list.size() > 1 ? 0.5f * (height - gap) : height);
  ImGui::BeginGroup();
  for (size_t side = 0; side < list.size(); ++side) ball_pane(w, side, std::min(edge, 0.25f * room));
  ImGui::EndGroup();
  ImGui::SameLine(0, gap);
  const Vec2 third(std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) / 3), height);
  ImGui::BeginGroup();
  for (size_t side = 0; side < list.size(); ++side) lobe_pane(w, side, {third.x, edge});
  ImGui::EndGroup();
  std::vector<bsdf_analysis::Slice> slices;
  std::vector<std::vector<bsdf_analysis::Albedo>> curves;
  for (const auto* reading : list) slices.push_back(reading->slice), curves.push_back(reading->audit.albedo);
  const auto look = look_of(w, third);
  ImGui::SameLine(0, gap);
  pane(w, "surface.polar", third, bsdf_analysis::polar_drawing(slices, names, look));
  if (ImGui::IsItemHovered()) tooltip(w, "f in the plane of incidence, for light to the eye on the left");
  ImGui::SameLine(0, gap);
  pane(w, "surface.albedo", third, bsdf_analysis::albedo_drawing(curves, names, look));
  if (ImGui::IsItemHovered())
    tooltip(w, "How much of the light leaves again, over the angle that it comes from; above 1 light is made");
}

}  // namespace

void draw_surface_sheet(Workbench& w) {
  if (w.selection.material < 0) return note(w, "Click something in the picture: its surface is measured here.");
  const auto list = readings(w);
  if (list.empty()) return note(w, "The surface is being measured.");
  constexpr float kControls = 20;  // letters wide
  with_controls(
      w, kControls * ImGui::GetFontSize(), [&] { instruments(w, list); }, controls);
}

}  // namespace etendue::viewer
