// A live comparison of methods: their errors over time or samples.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/method_spec.h"
#include "integrator/integrator.h"
#include "viewer/actions/action.h"
#include "viewer/panels/convergence_plot.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/tasks/convergence_task.h"
#include "viewer/viewport/comparison.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/chart_painter.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using Phase = bench::LiveBenchmarkSnapshot::Phase;

template <class E>
void compact_parameter(AppState& state, Choice<E>& choice) {
  const ParameterInfo info = describe(choice);
  if (const auto value = compact_choice(state, info, width_of_choice(state.ui, info))) assign(choice, *value);
}

template <class T>
void compact_parameter(AppState& state, Number<T>& number, float width) {
  if (const auto value = compact_number(state, describe(number), width)) assign(number, *value);
}

// A choice with the entries of a registry.
template <class Entries>
ParameterInfo registry_choice(const char* name, const char* label, const char* doc, const std::string& value,
                              const Entries& entries) {
  ParameterInfo info;
  info.name = name;
  info.label = label;
  info.doc = doc;
  info.type = ParameterType::choice;
  info.default_value = value;
  for (const auto& entry : entries) {
    info.options.push_back(entry.name);
    info.option_labels.push_back(entry.label);
  }
  return info;
}

ParameterInfo integrator_parameter(const std::string& value) {
  return registry_choice("compare.integrator", "Integrator", "Integrator of the method to add", value,
                         integrator::integrator_infos());
}

ParameterInfo sampler_parameter(const std::string& value) {
  return registry_choice("compare.sampler", "Sampler", "Sampler of the method to add", value, sampler_infos());
}

// A choice whose value is the name of an option.
void compact_name(AppState& state, const ParameterInfo& info, std::string& name) {
  if (const auto value = compact_choice(state, info, width_of_choice(state.ui, info)))
    name = std::get<std::string>(*value);
}

struct Column {
  const char* label;
  const char* tooltip;
};
constexpr Column kColumns[] = {
    {"", ""},
    {"method", "Integrator, sampler and parameters. The tooltip has the name for `etendue bench`"},
    {"error",
     "End of the curve: the median of the complete repeats, in the measure chosen below. The error of the reference is "
     "subtracted"},
    {"slope",
     "Slope of the logarithm of the error over the logarithm of the horizontal axis, with its standard error over "
     "repeats. Independent "
     "random numbers give -0.5, low-discrepancy points are steeper, bias makes the curve flat"},
    {"eff.", "Efficiency 1 / (squared error x time), relative to the best method"},
    {"spp", "Samples per pixel of the complete repeats, median"},
    {"s", "Rendering time of the complete repeats in seconds, median"},
    {"", ""},
};
constexpr size_t kValueColumns = 5;

void color_swatch(size_t method) {
  const float size = ImGui::GetFontSize() * 0.75f;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float top = corner.y + (ImGui::GetTextLineHeight() - size) * 0.5f;
  ImGui::GetWindowDrawList()->AddRectFilled({corner.x, top}, {corner.x + size, top + size},
                                            color_of(metrics::method_color(method)), 2);
  ImGui::Dummy({size, ImGui::GetTextLineHeight()});
  ImGui::SameLine(0, size * 0.6f);
}

// Continues on further lines below the first one where the column is too narrow.
void draw_wrapped(const std::string& text) {
  ImGui::BeginGroup();
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndGroup();
}

void cell(const std::string& text) {
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(text.c_str());
}

std::string slope_text(const metrics::Estimate& slope) {
  if (!slope.known) return "?";
  if (slope.degrees == 0) return formatted("%.2f", slope.value);
  return formatted("%.2f \u00b1%.2f", slope.value, slope.standard_error);
}

// What the table shows of a method: the same repeats and the same error as the curve.
struct Figures {
  metrics::CurveEnd end;
  metrics::Estimate slope, efficiency;
};

Figures figures_of(const bench::MethodStatus& method, const bench::LiveBenchmarkSnapshot& snapshot,
                   metrics::Abscissa axis, film::ErrorMeasure measure) {
  const metrics::MethodCurves complete = metrics::complete_repeats(method.corrected, axis);
  const auto noise = snapshot.reference_noise.value_or(metrics::ReferenceNoise{});
  return {.end = metrics::curve_end(method.corrected, axis, measure),
          .slope = metrics::slope_of(complete, axis, noise, measure),
          .efficiency = metrics::efficiency_of(complete, measure)};
}

double best_efficiency(const bench::LiveBenchmarkSnapshot& snapshot, metrics::Abscissa axis,
                       film::ErrorMeasure measure) {
  double best = 0;
  for (const auto& method : snapshot.methods) {
    const auto efficiency = metrics::efficiency_of(metrics::complete_repeats(method.corrected, axis), measure);
    if (efficiency.known) best = std::max(best, efficiency.value);
  }
  return best;
}

std::string end_error_text(film::ErrorMeasure measure, double error) {
  return measure == film::ErrorMeasure::rmse ? formatted("%.3g", error) : formatted("%.3g %%", 100 * error);
}

void value_cells(const AppState& state, const bench::LiveBenchmarkSnapshot& snapshot, const bench::MethodStatus& method,
                 metrics::Abscissa axis, film::ErrorMeasure measure) {
  const UiContext& ui = state.ui;
  if (!method.incompatibility.empty()) {
    cell("n/a");
    if (ImGui::IsItemHovered()) tooltip(ui, with_labels(state.document(), method.incompatibility).text);
    for (size_t i = 1; i < kValueColumns; ++i) cell("");
    return;
  }
  const Figures figures = figures_of(method, snapshot, axis, measure);
  if (figures.end.repeats == 0) {
    for (size_t i = 0; i < kValueColumns; ++i) cell("");
    return;
  }
  const auto& end = figures.end.point;
  cell(end ? end_error_text(measure, end->median) : "< ref.");
  if (ImGui::IsItemHovered())
    tooltip(ui, formatted("Median of %zu of %zu repeats", figures.end.repeats, method.corrected.repeats.size()));
  cell(slope_text(figures.slope));
  cell(figures.efficiency.known ? formatted("%.2f", figures.efficiency.value / best_efficiency(snapshot, axis, measure))
                                : "");
  cell(formatted("%.0f", figures.end.spp));
  cell(formatted("%.1f", figures.end.seconds));
}

class ConvergencePanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.convergence",
            .label = "Convergence",
            .description = "Compare methods: error over time",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    task_.propose_methods(state.document());
    const float em = ImGui::GetFontSize();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {em * 0.4f, em * 0.25f});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {em * 0.4f, em * 0.1f});
    if (width < em * (kListWidth + 1 + kChartWidth)) {
      draw_list(state);
      const float rest = ImGui::GetContentRegionAvail().y;
      draw_chart(state, {width, std::max(rest, std::min(em * kChartHeight, ImGui::GetWindowHeight()))});
    } else {
      ImGui::BeginChild("##list", {std::max(width * 0.46f, em * kListWidth), 0});
      draw_list(state);
      ImGui::EndChild();
      ImGui::SameLine(0, em);
      ImGui::BeginChild("##chart");
      draw_chart(state, ImGui::GetContentRegionAvail());
      ImGui::EndChild();
    }
    ImGui::PopStyleVar(2);
  }

  std::vector<ParameterInfo> parameters() const override {
    ConvergenceTask::Parameters defaults;
    auto list = describe_all(defaults.all());
    list.push_back(integrator_parameter(defaults.integrator));
    list.push_back(sampler_parameter(defaults.sampler));
    return list;
  }

  std::vector<ItemInfo> items() const override {
    return {{"compare.add", "Add", "Adds the selected integrator and sampler to the list of methods"},
            {"compare.a.N", "A", "Shows the image of method N to the left of the divider"},
            {"compare.b.N", "B", "Shows the image of method N to the right of the divider"},
            {"compare.method.N", "Method", "Method N of the list. The tooltip has its name for etendue bench"},
            {"compare.remove.N", "Remove", "Removes method N from the list"},
            {"compare.chart", "Chart", "The error curves. Move the pointer over the chart to read values"},
            {"compare.point.N", "Point", "Method N in the Pareto chart. A click uses the method"}};
  }

  void add_actions(ActionList& actions) override;
  std::vector<WaitCondition> wait_conditions() override;
  void report(AppState& state, nlohmann::json& json) override;

  void update(AppState& state) override { task_.update(state.task_context, *state.viewport.comparison); }
  std::vector<Task*> tasks() override { return {&task_}; }

 private:
  // The least sizes of the list and of the chart, times the font size. In narrower panels, the chart is below the list.
  static constexpr float kListWidth = 30, kChartWidth = 20, kChartHeight = 14;

  void draw_list(AppState& state) {
    draw_budget(state);
    draw_progress(state.ui);
    draw_methods(state);
    draw_new_method(state);
    draw_chart_parameters(state);
    draw_reference_status(state.ui);
  }

  void draw_chart(AppState& state, const ImVec2& size) {
    if (const auto chosen = draw_convergence_chart(state.ui, task_, size))
      use_method(state, task_.result()->methods[*chosen].name);
  }

  void draw_budget(AppState& state) {
    auto& parameters = task_.parameters;
    const float em = ImGui::GetFontSize();
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
    action_button(state, task_.running() ? "compare.stop" : "compare.start");
    ImGui::PopStyleColor();
    if (task_.can_resume()) {
      ImGui::SameLine();
      action_button(state, "compare.continue");
    }
    const float rule_width = width_of_choice(state.ui, describe(parameters.rule)), budget_width = em * 5.6f,
                repeats_width = em * 3;
    same_line_if_fits(rule_width + budget_width + repeats_width + 2 * ImGui::GetStyle().ItemSpacing.x);
    compact_parameter(state, parameters.rule);
    ImGui::SameLine();
    if (parameters.rule == bench::Rule::equal_time)
      compact_parameter(state, parameters.seconds, budget_width);
    else
      compact_parameter(state, parameters.samples, budget_width);
    ImGui::SameLine();
    compact_parameter(state, parameters.repeats, repeats_width);
  }

  void draw_progress(const UiContext& ui) const {
    const auto* snapshot = task_.result();
    const float height = std::max(2.0f, std::floor(2 * ui.scale));
    const float share = snapshot ? static_cast<float>(snapshot->progress) : 0;
    progress_line(share, ImGui::GetContentRegionAvail().x, height,
                  task_.running() ? ui.theme.accent : ui.theme.secondary_text);
  }

  void draw_methods(AppState& state) {
    ImGui::PushFont(state.ui.fonts.small);
    const float em = ImGui::GetFontSize();
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {em * 0.4f, std::floor(em * 0.2f)});
    std::optional<size_t> removed;
    const int columns = static_cast<int>(std::size(kColumns));
    if (ImGui::BeginTable("##methods", columns, ImGuiTableFlags_SizingFixedFit)) {
      for (size_t i = 0; i < std::size(kColumns); ++i)
        ImGui::TableSetupColumn(kColumns[i].label,
                                i == 1 ? ImGuiTableColumnFlags_WidthStretch : ImGuiTableColumnFlags_WidthFixed);
      ImGui::TableNextRow();
      for (const Column& column : kColumns) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", column.label);
        if (*column.tooltip && ImGui::IsItemHovered()) tooltip(state.ui, column.tooltip);
      }
      for (size_t row = 0; row < task_.parameters.methods.size(); ++row) {
        ImGui::PushID(static_cast<int>(row));
        if (draw_method(state, row)) removed = row;
        ImGui::PopID();
      }
      ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::PopFont();
    if (removed) task_.remove_method(*removed);
  }

  // Returns true if the method is to be removed.
  bool draw_method(AppState& state, size_t row) {
    UiContext& ui = state.ui;
    auto& parameters = task_.parameters;
    const std::string& spec = parameters.methods[row];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    draw_side_button(ui, "A", "compare.a.", row, parameters.a);
    ImGui::SameLine(0, 2);
    draw_side_button(ui, "B", "compare.b.", row, parameters.b);
    ImGui::TableNextColumn();
    const auto index = task_.index_in_result(spec);
    color_swatch(index.value_or(row));
    draw_wrapped(method_label(spec));
    ui.items.add("compare.method." + std::to_string(row));
    if (ImGui::IsItemHovered()) tooltip(ui, method_label(spec) + "\n" + spec);
    if (index)
      value_cells(state, *task_.result(), task_.result()->methods[*index], parameters.axis, parameters.error);
    else
      for (size_t i = 0; i < kValueColumns; ++i) cell("");
    ImGui::TableNextColumn();
    const bool removed = ImGui::SmallButton("\u00d7");
    ui.items.add("compare.remove." + std::to_string(row));
    if (ImGui::IsItemHovered()) tooltip(ui, "Removes the method from the list");
    return removed;
  }

  // A button that shows the image of a method on one side of the viewport.
  void draw_side_button(UiContext& ui, const char* letter, const char* item, size_t row, size_t& selected) {
    const bool is_selected = selected == row;
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(is_selected ? ImGuiCol_Header : ImGuiCol_FrameBg));
    ImGui::PushStyleColor(ImGuiCol_Text, is_selected ? ui.theme.text : ui.theme.secondary_text);
    if (ImGui::SmallButton(letter)) {
      selected = row;
      task_.request_images();
    }
    ImGui::PopStyleColor(2);
    ui.items.add(item + std::to_string(row));
    if (ImGui::IsItemHovered()) tooltip(ui, std::string("Shows the image of this method as ") + letter);
  }

  void draw_new_method(AppState& state) {
    auto& parameters = task_.parameters;
    compact_name(state, integrator_parameter(parameters.integrator), parameters.integrator);
    const ParameterInfo sampler = sampler_parameter(parameters.sampler);
    same_line_if_fits(width_of_choice(state.ui, sampler));
    compact_name(state, sampler, parameters.sampler);
    if (ImGui::Button("Add"))
      task_.add_method(parameters.integrator + ":sampler=" + parameters.sampler +
                       (parameters.denoised ? ":denoise=true" : ""));
    state.ui.items.add("compare.add");
    if (ImGui::IsItemHovered()) tooltip(state.ui, "Adds this method to the list");
    ImGui::SameLine();
    action_button(state, "compare.add-current");
    ImGui::SameLine();
    if (const auto value = compact_toggle(state, describe(parameters.denoised))) assign(parameters.denoised, *value);
    const auto methods = parameter_widget(state, describe(parameters.added));
    if (!methods) return;
    if (const auto added = task_.add_methods(std::get<std::string>(*methods), state.document()); !added)
      state.notices.add_error(added.error().message);
  }

  void draw_chart_parameters(AppState& state) {
    compact_parameter(state, task_.parameters.chart);
    same_line_if_fits(width_of_choice(state.ui, describe(task_.parameters.error)));
    compact_parameter(state, task_.parameters.error);
    same_line_if_fits(width_of_choice(state.ui, describe(task_.parameters.axis)));
    compact_parameter(state, task_.parameters.axis);
    same_line_if_fits(ImGui::GetFontSize() * 8);
    action_button(state, "compare.export");
  }

  static void use_method(AppState& state, const std::string& spec) {
    auto method = bench::parse_method(spec, state.document());
    if (!method) return state.notices.add_error(method.error().message);
    state.edit(std::move(method->document), "Method");
  }

  void draw_reference_status(const UiContext& ui) const {
    const auto* snapshot = task_.result();
    if (!snapshot) return;
    ImGui::PushFont(ui.fonts.small);
    std::string text = snapshot->phase == Phase::preparing
                           ? "preparing"
                           : formatted("repeat %d of %d", snapshot->repeat, snapshot->repeats);
    if (snapshot->reference)
      text += formatted("; reference: %u spp, %.1f s", snapshot->reference_samples, snapshot->reference_seconds);
    if (std::isfinite(snapshot->reference_error)) text += formatted(", standard error %.2g", snapshot->reference_error);
    note(ui, text);
    if (snapshot->too_noisy)
      warning(ui,
              formatted("Reference too noisy: errors below about %.2g are uncertain. Continue to refine it.",
                        metrics::smallest_certain_rmse(snapshot->reference_noise.value_or(metrics::ReferenceNoise{}))));
    ImGui::PopFont();
  }

  void request_export(AppState& state) {
    state.files.request =
        FileRequest{.title = "Export the chart (.svg, .png) or its data (.csv)",
                    .extensions = {".svg", ".png", ".csv"},
                    .saves = true,
                    .name = scene_stem(state.document()) + "-convergence.svg",
                    .accept = [this, &state](const std::string& file) { task_.save_chart(state.task_context, file); }};
  }

  ConvergenceTask task_;
};

void ConvergencePanel::add_actions(ActionList& actions) {
  const auto has_document = [](const AppState& state) { return state.has_document(); };
  const auto start = [this](AppState& state) {
    state.panels.open(*this);
    task_.propose_methods(state.document());
    const auto started = task_.start(state.task_context);
    if (!started) state.notices.add_error(started.error().message);
  };
  actions.add({.name = "compare.start",
               .menu = "Compare",
               .label = "Start comparison",
               .tooltip = "Renders the methods of the Convergence panel in turns and plots their errors over time",
               .run = start,
               .enabled = has_document,
               .group = "Methods"});
  actions.add({.name = "compare.stop",
               .menu = "Compare",
               .label = "Stop comparison",
               .tooltip = "Stops the comparison. The curves stay",
               .run = [this](AppState& state) { task_.stop(state.task_context); },
               .enabled = [this](const AppState&) { return task_.running(); },
               .group = "Methods"});
  actions.add({.name = "compare.continue",
               .menu = "Compare",
               .label = "Continue",
               .tooltip = "Continues the comparison. Doubles the budget if it is used up",
               .run = [this](AppState& state) { task_.resume(state.task_context); },
               .enabled = [this](const AppState&) { return task_.can_resume(); },
               .group = "Methods"});
  actions.add({.name = "compare.add-current",
               .menu = "Compare",
               .label = "Add current",
               .tooltip = "Adds the method of the Render panel to the list",
               .run = [this](AppState& state) { task_.add_method(method_spec(state.document().method)); },
               .enabled = has_document,
               .group = "Methods"});
  actions.add({.name = "compare.export",
               .menu = "Compare",
               .label = "Export chart...",
               .tooltip = "Saves the chart as .svg or .png, or its data as .csv",
               .run = [this](AppState& state) { request_export(state); },
               .enabled = [this](const AppState&) { return task_.result() != nullptr; },
               .group = "Methods"});
}

std::vector<WaitCondition> ConvergencePanel::wait_conditions() {
  const auto check = [this](AppState&, std::optional<uint32_t> samples) -> StepStatus {
    const auto* snapshot = task_.result();
    if (!snapshot) return {.error = "no methods are compared; click compare.start first"};
    if (!samples) {
      const bool at_rest = snapshot->phase == Phase::stopped || snapshot->phase == Phase::done;
      return {.done = !task_.running() && at_rest && !task_.is_saving()};
    }
    const auto has_samples = [&](const bench::MethodStatus& method) { return method.samples >= *samples; };
    if (std::ranges::all_of(snapshot->methods, has_samples)) return {.done = true};
    if (task_.running()) return {};
    return {.error = "the comparison has ended with fewer samples; increase its budget"};
  };
  return {{.name = "contest", .check = check}};
}

void ConvergencePanel::report(AppState&, nlohmann::json& json) {
  auto& report = json["contest"];
  report = {{"running", task_.running()}, {"up_to_date", task_.is_current()}, {"methods", nlohmann::json::array()}};
  const auto* snapshot = task_.result();
  if (!snapshot) return;
  constexpr const char* kPhases[] = {"preparing", "comparing", "stopped", "done"};
  report["phase"] = kPhases[static_cast<size_t>(snapshot->phase)];
  report["progress"] = snapshot->progress;
  report["repeat"] = snapshot->repeat;
  report["reference"] = {{"samples", snapshot->reference_samples},
                         {"seconds", snapshot->reference_seconds},
                         {"too_noisy", snapshot->too_noisy}};
  if (std::isfinite(snapshot->reference_error)) report["reference"]["error"] = snapshot->reference_error;
  for (const auto& m : snapshot->methods) {
    nlohmann::json method{
        {"name", m.name}, {"samples", m.samples}, {"seconds", m.seconds}, {"rmse", m.rmse}, {"slope", nullptr}};
    if (m.slope.known) method["slope"] = m.slope.value;
    const auto end = metrics::curve_end(m.corrected, task_.parameters.axis, task_.parameters.error);
    method["error"] = end.point ? nlohmann::json(end.point->median) : nlohmann::json();
    method["repeats"] = end.repeats;
    method["incompatibility"] = m.incompatibility;
    report["methods"].push_back(std::move(method));
  }
}

}  // namespace

std::unique_ptr<Panel> make_convergence_panel() { return std::make_unique<ConvergencePanel>(); }

}  // namespace etendue::viewer
