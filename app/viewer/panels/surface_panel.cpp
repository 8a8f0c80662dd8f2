// The BSDF of the selected material: preview, lobe, slice and albedo, next to those of a pinned material.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "viewer/actions/action.h"
#include "viewer/panels/panel.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/tasks/surface_analysis.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/chart_painter.h"
#include "viewer/widgets/filter_box.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/surface_checks.h"
#include "viewer/widgets/thumbnails.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using Measurements = std::vector<const SurfaceMeasurement*>;

std::vector<std::string> model_names(const Measurements& measurements) {
  std::vector<std::string> names;
  for (const auto* measurement : measurements) names.push_back(measurement->model);
  return names;
}

class SurfacePanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.surface",
            .label = "Surface",
            .description = "BSDF of the selected material: preview, lobe, slice, albedo and checks",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    if (state.selection.material < 0) return note(state.ui, "Click a surface in the image to analyse its material.");
    Measurements measurements;
    for (size_t side = 0; side < SurfaceAnalysis::kSides; ++side)
      if (const auto* measurement = state.tasks.surface_analysis->result(side)) measurements.push_back(measurement);
    if (measurements.empty()) return note(state.ui, "Measuring the material.");
    with_controls(
        state.ui, kControlColumnWidth * ImGui::GetFontSize(), [&] { draw_charts(state, measurements); },
        [&] { draw_controls(state); });
  }

  std::vector<ParameterInfo> parameters() const override { return describe_all(SurfaceAnalysis::Parameters{}.all()); }

  std::vector<ItemInfo> items() const override {
    return {{"surface.check.NAME", "Check", "The result of a check. The tooltip has the measured values"},
            {"surface.preview", "Preview", "The selected material on a sphere"},
            {"surface.preview-pinned", "Preview of the pinned material", "The pinned material on a sphere"},
            {"surface.lobe", "Lobe", "The BSDF lobe of the selected material. Drag to rotate the view"},
            {"surface.lobe-pinned", "Lobe of the pinned material", "Drag to rotate the view"},
            {"surface.polar", "Slice", "The BSDF in the plane of incidence"},
            {"surface.albedo", "Albedo", "Albedo as a function of the angle of incidence"}};
  }

  void add_actions(ActionList& actions) override {
    actions.add({.name = "surface.pin",
                 .menu = "Compare",
                 .label = "Pin material for comparison",
                 .tooltip = "Keeps the selected material as it is now and shows other materials next to it",
                 .run =
                     [this](AppState& state) {
                       state.tasks.surface_analysis->pin();
                       state.panels.open(*this);
                     },
                 .enabled = [](const AppState& state) { return state.tasks.surface_analysis->can_pin(); },
                 .group = "Materials"});
    actions.add({.name = "surface.unpin",
                 .menu = "Compare",
                 .label = "Unpin material",
                 .tooltip = "Shows only the selected material",
                 .run = [](AppState& state) { state.tasks.surface_analysis->unpin(); },
                 .enabled = [](const AppState& state) { return state.tasks.surface_analysis->has_pinned(); },
                 .group = "Materials"});
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [this](AppState& state, std::optional<uint32_t>) -> StepStatus {
      const SurfaceAnalysis& analysis = *state.tasks.surface_analysis;
      const bool open = state.panels.is_open(*this);
      if (state.selection.material < 0) return {.error = "no material is selected"};
      if (!open && !analysis.checks_are_shown())
        return {.error = "the material is analysed while a panel shows it; click panel.surface or tab.material first"};
      return {.done = analysis.is_current() && (!open || analysis.preview(0).pixels)};
    };
    return {{.name = "surface", .check = check}};
  }

  void report(AppState& state, nlohmann::json& json) override {
    const SurfaceAnalysis& analysis = *state.tasks.surface_analysis;
    auto& surface = json["surface"];
    surface = {{"fresh", analysis.is_current()}, {"sides", nlohmann::json::array()}};
    for (size_t side = 0; side < SurfaceAnalysis::kSides; ++side) {
      const SurfaceMeasurement* measurement = analysis.result(side);
      if (!measurement) continue;
      auto checks = nlohmann::json::object();
      for (const auto& check : measurement->audit.checks) checks[check.name] = check.holds;
      surface["sides"].push_back({{"model", measurement->model},
                                  {"badges", checks},
                                  {"albedo", bsdf_analysis::hemispherical_albedo(measurement->audit.albedo)},
                                  {"ball_samples", analysis.preview(side).samples}});
    }
  }

  void update(AppState& state) override {
    if (state.is_visible(*this)) state.tasks.surface_analysis->request_previews();
  }

 private:
  // Previews, lobes, slices and albedo side by side. With two materials, previews and lobes are above each other.
  void draw_charts(AppState& state, const Measurements& measurements) {
    UiContext& ui = state.ui;
    const auto names = model_names(measurements);
    const float em = ImGui::GetFontSize();
    const float gap = std::floor(0.5f * em);
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = std::max(ImGui::GetContentRegionAvail().y, 9 * em);
    const float row_height = std::floor(measurements.size() > 1 ? 0.5f * (height - gap) : height);
    ImGui::BeginGroup();
    for (size_t side = 0; side < measurements.size(); ++side)
      draw_preview(state, side, std::min(row_height, 0.25f * width));
    ImGui::EndGroup();
    ImGui::SameLine(0, gap);
    const Vec2 chart_size(std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) / 3), height);
    ImGui::BeginGroup();
    for (size_t side = 0; side < measurements.size(); ++side) draw_lobe(state, side, {chart_size.x, row_height});
    ImGui::EndGroup();
    std::vector<bsdf_analysis::Slice> slices;
    std::vector<std::vector<bsdf_analysis::Albedo>> albedo_curves;
    for (const auto* measurement : measurements) {
      slices.push_back(measurement->slice);
      albedo_curves.push_back(measurement->audit.albedo);
    }
    const auto options = drawing_options(state, chart_size);
    ImGui::SameLine(0, gap);
    draw_chart(ui, "surface.polar", chart_size, bsdf_analysis::polar_drawing(slices, names, options));
    if (ImGui::IsItemHovered())
      tooltip(ui,
              "The BSDF in the plane of incidence as a function of the light direction. The line points to the "
              "camera");
    ImGui::SameLine(0, gap);
    draw_chart(ui, "surface.albedo", chart_size, bsdf_analysis::albedo_drawing(albedo_curves, names, options));
    if (ImGui::IsItemHovered())
      tooltip(ui,
              "Share of the incident light that is scattered, as a function of the angle of incidence. Above 1, "
              "energy is not conserved");
  }

  void draw_preview(AppState& state, size_t side, float size) {
    const auto& preview = state.tasks.surface_analysis->preview(side);
    const char* name = side == 0 ? "surface.preview" : "surface.preview-pinned";
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(name, {size, size});
    state.ui.items.add(name);
    if (ImGui::IsItemHovered()) tooltip(state.ui, "Progressive rendering of the material under the preview light");
    if (!preview.pixels) return;
    const ThumbnailImage image{.width = preview.width, .height = preview.height, .pixels = preview.pixels};
    ImGui::GetWindowDrawList()->AddImage(thumbnails_.texture(state.platform.gl(), side, image), corner,
                                         {corner.x + size, corner.y + size});
  }

  void draw_lobe(AppState& state, size_t side, const Vec2& size) {
    const SurfaceMeasurement* measurement = state.tasks.surface_analysis->result(side);
    if (!measurement) return;
    const auto drawing =
        bsdf_analysis::lobe_drawing(measurement->lobes, measurement->slice.degrees, drawing_options(state, size));
    const bool dragged = draw_chart(state.ui, side == 0 ? "surface.lobe" : "surface.lobe-pinned", size, drawing);
    if (ImGui::IsItemHovered() && !dragged)
      tooltip(state.ui, "The BSDF f for the view direction \u03c9o. Drag to rotate");
    if (!dragged) return;
    constexpr double kDegreesPerPixel = 0.5;
    const ImVec2 movement = ImGui::GetIO().MouseDelta;
    azimuth_ += kDegreesPerPixel * static_cast<double>(movement.x);
    elevation_ = std::clamp(elevation_ + kDegreesPerPixel * static_cast<double>(movement.y), -10.0, 90.0);
  }

  void draw_controls(AppState& state) {
    SurfaceAnalysis& analysis = *state.tasks.surface_analysis;
    for (size_t side = 0; side < SurfaceAnalysis::kSides; ++side) {
      const SurfaceMeasurement* measurement = analysis.result(side);
      if (!measurement) continue;
      ImGui::PushID(static_cast<int>(side));
      ImGui::TextColored(text_color(metrics::method_color(side), state.ui.theme), "%s%s", measurement->model.c_str(),
                         side == 1 ? " (pinned)" : "");
      draw_values(state.ui, *measurement);
      ImGui::PopID();
    }
    filtered_parameters(state, [&] { parameter_widgets(state, analysis.parameters.all()); });
    action_button(state, "surface.pin");
    if (analysis.has_pinned()) action_button(state, "surface.unpin");
  }

  static void draw_values(UiContext& ui, const SurfaceMeasurement& measurement) {
    draw_surface_checks(ui, &measurement);
    labelled_value(ui, "Hemispherical albedo",
                   formatted("%.4f", bsdf_analysis::hemispherical_albedo(measurement.audit.albedo)),
                   "Share of uniform light from all directions that is scattered");
    for (const auto& quality : measurement.audit.sampling)
      if (quality.degrees == 45)
        labelled_value(ui, "Std. dev. at 45\u00b0",
                       formatted("%.2f (cosine %.2f)", quality.deviation, quality.cosine_deviation),
                       "Relative standard deviation of one sample at 45\u00b0: BSDF sampling, and cosine-weighted "
                       "sampling for comparison");
  }

  bsdf_analysis::DrawingOptions drawing_options(const AppState& state, const Vec2& size) const {
    bsdf_analysis::DrawingOptions options;
    // In units of the interface, so that lines have the same width on all displays.
    options.width = static_cast<int>(size.x / state.ui.scale);
    options.height = static_cast<int>(size.y / state.ui.scale);
    options.palette = chart_palette(state.ui.theme);
    options.length_scale = state.tasks.surface_analysis->parameters.length;
    options.azimuth = azimuth_;
    options.elevation = elevation_;
    return options;
  }

  Thumbnails thumbnails_;
  double azimuth_ = 145;  // of the view on lobes, degrees
  double elevation_ = 25;
};

}  // namespace

std::unique_ptr<Panel> make_surface_panel() { return std::make_unique<SurfacePanel>(); }

}  // namespace etendue::viewer
