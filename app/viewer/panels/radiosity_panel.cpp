// The solution of the radiosity equation: convergence of the solver, closure and reciprocity of the form factors, and the
// patches over the image.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "metrics/function_chart.h"
#include "render/session.h"
#include "spectrum/colormap.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/tasks/radiosity_task.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/chart_painter.h"
#include "viewer/widgets/filter_box.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/scale_bar.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {

enum class PatchQuantity : uint8_t { none, edges, radiosity, unshot, closure, reciprocity };
enum class ResidualAxis : uint8_t { sweeps, seconds };

}  // namespace etendue::viewer

template <>
struct etendue::Options<etendue::viewer::PatchQuantity> {
  static constexpr std::array<etendue::Option, 6> kOptions{{{"none", "Not shown"},
                                                            {"edges", "Edges"},
                                                            {"radiosity", "Radiosity"},
                                                            {"unshot", "Unshot power"},
                                                            {"closure", "Closure"},
                                                            {"reciprocity", "Reciprocity"}}};
};

template <>
struct etendue::Options<etendue::viewer::ResidualAxis> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"sweeps", "Sweeps"}, {"seconds", "Seconds"}}};
};

namespace etendue::viewer {
namespace {

using integrator::SolutionView;

constexpr const char* kComponents[] = {"Red", "Green", "Blue"};
constexpr double kUnshotDecades = 4;         // of the colour scale of unshot power
constexpr float kSolverControlsBeside = 48;  // width from which the chart is beside the controls, em

struct PanelSettings {
  Choice<PatchQuantity> overlay{"patches.overlay", "Patches", PatchQuantity::none,
                                "Draws the visible patches over the image, coloured by this quantity"};
  Choice<ResidualAxis> axis{"patches.axis", "Residual over", ResidualAxis::sweeps,
                            "What the chart of the solver's residual counts"};
  auto all() { return std::tie(overlay, axis); }
};

double quantity_of(PatchQuantity quantity, const SolutionView::Side& side, float area) {
  switch (quantity) {
    case PatchQuantity::radiosity:
      return luminance(side.radiosity);
    case PatchQuantity::unshot:
      return std::abs(luminance(side.unshot)) * area;
    case PatchQuantity::closure:
      return side.closure;
    case PatchQuantity::reciprocity:
      return side.asymmetry;
    case PatchQuantity::none:
    case PatchQuantity::edges:
      break;
  }
  return 0;
}

const char* title_of(PatchQuantity quantity) {
  switch (quantity) {
    case PatchQuantity::radiosity:
      return "radiosity, W/m\u00b2";
    case PatchQuantity::unshot:
      return "unshot power, W";
    case PatchQuantity::closure:
      return "sum of form factors";
    case PatchQuantity::reciprocity:
      return "difference of reciprocal estimates";
    case PatchQuantity::none:
    case PatchQuantity::edges:
      break;
  }
  return "";
}

// From values to 0..1: logarithmic for unshot power, which spans decades, otherwise linear from 0.
struct ColorScale {
  double most = 0;
  bool logarithmic = false;

  float position(double value) const {
    if (!(most > 0)) return 0;
    if (!logarithmic) return static_cast<float>(value / most);
    return value > 0 ? static_cast<float>(1 + std::log10(value / most) / kUnshotDecades) : 0;
  }
  double value_at(double position) const {
    return logarithmic ? most * std::pow(10, (position - 1) * kUnshotDecades) : position * most;
  }
};

ColorScale scale_of(PatchQuantity quantity, const VisibleSolution& visible) {
  ColorScale scale{.most = 0, .logarithmic = quantity == PatchQuantity::unshot};
  std::vector<double> values;
  for (const VisiblePatch& p : visible.patches)
    values.push_back(quantity_of(quantity, visible.side(p), visible.solution->patches[p.patch].area));
  if (values.empty()) return scale;
  // A few patches next to a light must not leave all others dark.
  const bool by_quantile = quantity == PatchQuantity::radiosity;
  const size_t rank = by_quantile ? values.size() * 98 / 100 : values.size() - 1;
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(rank));
  scale.most = values[rank];
  return scale;
}

class RadiosityPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.radiosity",
            .label = "Radiosity",
            .description = "Convergence of the radiosity solver, closure and reciprocity of form factors, patches",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    const VisibleSolution* visible = task_.result();
    const bool has_solution = visible && visible->solution;
    const float em = ImGui::GetFontSize();
    const bool side_by_side = ImGui::GetContentRegionAvail().x >= kSolverControlsBeside * em;
    if (side_by_side) ImGui::BeginChild("##controls", {kControlColumnWidth * em, 0});
    filtered_parameters(state, [&] { parameter_widgets(state, settings_.all()); });
    if (has_solution) draw_values(state, *visible->solution);
    if (side_by_side) {
      ImGui::EndChild();
      ImGui::SameLine(0, em);
      ImGui::BeginChild("##residuals");
    }
    if (!visible)
      note(state.ui, "The solution is not known yet.");
    else if (!has_solution)
      note(state.ui, "The integrator has no radiosity solution. Select Radiosity in the Render panel.");
    else
      draw_residuals(state, *visible->solution);
    if (side_by_side) ImGui::EndChild();
  }

  std::vector<ParameterInfo> parameters() const override {
    PanelSettings defaults;
    return describe_all(defaults.all());
  }
  std::vector<ItemInfo> items() const override {
    return {{"patches.residuals", "Residuals", "The residual of the radiosity equation, by colour component"}};
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [this](AppState&, std::optional<uint32_t>) -> StepStatus {
      const VisibleSolution* visible = task_.result();
      if (visible && !visible->solution) return {.error = "the integrator has no radiosity solution"};
      return {.done = visible && visible->solution->is_complete};
    };
    return {{.name = "radiosity", .check = check, .needs_frames = true}};
  }

  void report(AppState&, nlohmann::json& json) override {
    const VisibleSolution* visible = task_.result();
    if (!visible || !visible->solution) return;
    const SolutionView& solution = *visible->solution;
    json["radiosity"] = {{"patches", solution.patches.size()},
                         {"visible_patches", visible->patches.size()},
                         {"complete", solution.is_complete},
                         {"sweeps", sweeps_of(solution)},
                         {"problem", solution.problem}};
  }

  void update(AppState& state) override {
    const bool is_needed = state.is_visible(*this) || settings_.overlay.value != PatchQuantity::none;
    task_.update(state.task_context, is_needed);
  }
  std::vector<Task*> tasks() override { return {&task_}; }

  void draw_overlay(AppState& state, ImDrawList& draw) override {
    const VisibleSolution* visible = task_.result();
    if (settings_.overlay.value == PatchQuantity::none || !visible || !visible->solution || state.shows_aov()) return;
    draw_patches(state, *visible, draw);
    if (settings_.overlay.value != PatchQuantity::edges) draw_scale(state, *visible, draw);
    if (!ImGui::GetIO().WantCaptureMouse) draw_patch_tooltip(state, *visible);
  }

 private:
  static size_t sweeps_of(const SolutionView& solution) {
    size_t most = 0;
    for (const auto& h : solution.history) most = std::max(most, h.residuals.size());
    return most == 0 ? 0 : most - 1;
  }

  void draw_values(AppState& state, const SolutionView& solution) const {
    const UiContext& ui = state.ui;
    labelled_value(ui, "Solver", solution.solver);
    labelled_value(ui, "Patches", std::to_string(solution.patches.size()), "Each patch has two sides");
    // In the colours of the curves.
    for (size_t c = 0; c < solution.history.size(); ++c)
      if (const size_t residuals = solution.history[c].residuals.size(); residuals > 0)
        ImGui::TextColored(text_color(metrics::method_color(c), ui.theme), "%s: %zu sweeps", kComponents[c],
                           residuals - 1);
    labelled_value(ui, "State", solution.is_complete ? "solved" : solution.has_factors ? "solving" : "form factors");
    if (!solution.problem.empty()) warning(ui, solution.problem);
  }

  void draw_residuals(AppState& state, const SolutionView& solution) const {
    const bool by_time = settings_.axis.value == ResidualAxis::seconds;
    metrics::FunctionChart chart{.title = "Residual",
                                 .x_label = by_time ? "seconds" : "sweeps",
                                 .y_label = "residual, relative to the largest source",
                                 .curves = {},
                                 .logarithmic_y = true};
    for (size_t c = 0; c < solution.history.size(); ++c) {
      metrics::FunctionCurve curve{.name = kComponents[c], .points = {}};
      const auto& history = solution.history[c];
      for (size_t n = 0; n < history.residuals.size(); ++n)
        curve.points.push_back({by_time ? history.seconds[n] : static_cast<double>(n), history.residuals[n]});
      chart.curves.push_back(std::move(curve));
    }
    if (std::ranges::all_of(chart.curves, [](const auto& curve) { return curve.points.empty(); }))
      return note(state.ui, solution.is_complete ? "The reflections were added one by one; there is no residual."
                                                 : "The solver has not started yet.");
    const ImVec2 available = ImGui::GetContentRegionAvail();
    const Vec2 size(available.x, std::max(available.y, 8 * ImGui::GetFontSize()));
    metrics::ChartOptions options;
    options.palette = chart_palette(state.ui.theme);
    options.width = static_cast<int>(size.x / state.ui.scale);
    options.height = static_cast<int>(size.y / state.ui.scale);
    draw_chart(state.ui, "patches.residuals", size, metrics::function_drawing(chart, options));
  }

  void draw_patches(const AppState& state, const VisibleSolution& visible, ImDrawList& draw) const {
    const PatchQuantity quantity = settings_.overlay.value;
    const Placement& image = state.viewport.image;
    const Vec2 pixel_size = image.size / Vec2(state.document().width, state.document().height);
    const ColorScale scale = scale_of(quantity, visible);
    for (const VisiblePatch& p : visible.patches) {
      std::array<ImVec2, 3> at;
      for (size_t k = 0; k < 3; ++k) {
        const Vec2 corner = image.corner + p.corners[k] * pixel_size;
        at[k] = {corner.x, corner.y};
      }
      if (quantity != PatchQuantity::edges) {
        const double value = quantity_of(quantity, visible.side(p), visible.solution->patches[p.patch].area);
        const Rgb color = viridis(scale.position(value));
        draw.AddTriangleFilled(at[0], at[1], at[2], ImGui::GetColorU32(ImVec4(color.r, color.g, color.b, 0.9f)));
      }
      draw.AddTriangle(at[0], at[1], at[2], IM_COL32(0, 0, 0, 110), 1);
    }
  }

  void draw_scale(const AppState& state, const VisibleSolution& visible, ImDrawList& draw) const {
    const ColorScale scale = scale_of(settings_.overlay.value, visible);
    std::string labels[5];
    for (int i = 0; i <= 4; ++i) labels[i] = formatted("%.2g", scale.value_at(i / 4.0));
    draw_scale_bar(state.ui, &draw, state.viewport.visible_image(), viridis, labels, title_of(settings_.overlay.value));
  }

  // The values of the patch at the pointer.
  void draw_patch_tooltip(const AppState& state, const VisibleSolution& visible) const {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const Placement& image = state.viewport.visible_image();
    if (!image.contains({mouse.x, mouse.y})) return;
    const Vec2 pixel = (Vec2(mouse.x, mouse.y) - state.viewport.image.corner) / state.viewport.image.size *
                       Vec2(state.document().width, state.document().height);
    // The nearest patch is the last one.
    const auto found = std::find_if(visible.patches.rbegin(), visible.patches.rend(),
                                    [&](const auto& p) { return p.contains(pixel); });
    if (found == visible.patches.rend()) return;
    const SolutionView::Side& side = visible.side(*found);
    const SolutionView::Patch& patch = visible.solution->patches[found->patch];
    tooltip(state.ui,
            formatted("Patch %u, %s side, %.3g m\u00b2\nSum of form factors %.4f\nReciprocity %.2g\nRadiosity %.3g "
                      "W/m\u00b2\nUnshot power %.2g W",
                      found->patch, found->front ? "front" : "back", static_cast<double>(patch.area),
                      static_cast<double>(side.closure), static_cast<double>(side.asymmetry),
                      static_cast<double>(luminance(side.radiosity)),
                      static_cast<double>(luminance(side.unshot) * patch.area)));
  }

  PanelSettings settings_;
  RadiosityTask task_;
};

}  // namespace

std::unique_ptr<Panel> make_radiosity_panel() { return std::make_unique<RadiosityPanel>(); }

}  // namespace etendue::viewer
