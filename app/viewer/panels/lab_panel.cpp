// Experiments on integration, sampling and integral equations: parameters, charts, and measured against known values.
#include <imgui.h>

#include <map>
#include <nlohmann/json.hpp>

#include "experiments/experiment_output.h"
#include "viewer/actions/action.h"
#include "viewer/files/file_request.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/tasks/lab_task.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/chart_painter.h"
#include "viewer/widgets/filter_box.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using experiments::Chart;
using experiments::Experiment;
using experiments::ExperimentResult;

constexpr const char* kExportExperiment = "lab.export";
// Widths from which parts are side by side, in font sizes.
constexpr float kControlsBeside = 48, kNumbersBeside = 60;
constexpr float kMinChartWidth = 15, kMinChartHeight = 12;  // em

constexpr Number<int> kSeed{
    "lab.seed", "Seed", 0, {0, 65535}, "Seed of the random numbers; another seed gives independent noise"};

metrics::Color faded(metrics::Color color, double opacity) {
  color.opacity *= opacity;
  return color;
}

// Logarithmic charts have many lines, so that they are fainter than those of other charts.
metrics::ChartPalette lab_palette(const Theme& theme) {
  metrics::ChartPalette palette = chart_palette(theme);
  palette.grid = faded(palette.grid, 0.4);
  palette.minor_grid = faded(palette.minor_grid, 0.4);
  return palette;
}

// Names of parameters of an experiment are "lab.EXPERIMENT.NAME".
std::string experiment_prefix(const Experiment& experiment) {
  return "lab." + std::string(experiment.description.name) + ".";
}

ParameterInfo experiment_choice(const std::string& selected) {
  ParameterInfo info;
  info.name = "lab.experiment";
  info.label = "Experiment";
  info.doc = "What is computed and compared with theory";
  info.type = ParameterType::choice;
  info.default_value = selected;
  for (const Experiment& e : experiments::experiments()) {
    info.options.emplace_back(e.description.name);
    info.option_labels.emplace_back(e.description.label);
  }
  return info;
}

class LabPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.lab",
            .label = "Lab",
            .description = "Experiments on integration, sampling and integral equations, with known results",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    const float em = ImGui::GetFontSize();
    const bool side_by_side = ImGui::GetContentRegionAvail().x >= kControlsBeside * em;
    if (side_by_side) {
      ImGui::BeginChild("##controls", {kControlColumnWidth * em, 0});
      draw_controls(state);
      ImGui::EndChild();
      ImGui::SameLine(0, em);
      ImGui::BeginChild("##outcome");
    } else {
      draw_controls(state);
    }
    ImGui::PushFont(state.ui.fonts.small);
    draw_outcome(state);
    ImGui::PopFont();
    if (side_by_side) ImGui::EndChild();
  }

  std::vector<ParameterInfo> parameters() const override {
    std::vector<ParameterInfo> list{experiment_choice(experiments::experiments().front().description.name),
                                    describe(kSeed)};
    for (const Experiment& e : experiments::experiments())
      for (ParameterInfo p : e.parameters) {
        p.name = experiment_prefix(e) + p.name;
        list.push_back(std::move(p));
      }
    return list;
  }

  std::string place_of(const std::string& parameter) const override {
    for (const Experiment& e : experiments::experiments())
      if (parameter.starts_with(experiment_prefix(e))) return "Lab: " + std::string(e.description.label);
    return Panel::place_of(parameter);
  }

  std::vector<ItemInfo> items() const override {
    return {{"lab.chart.N", "Chart", "A chart of the experiment, the first one is 0"},
            {"lab.table", "Table", "The numbers of the experiment, and comparisons with known values"}};
  }

  void add_actions(ActionList& actions) override {
    actions.add({.name = kExportExperiment,
                 .menu = "View",
                 .label = "Export experiment...",
                 .tooltip = "Saves the charts (.svg, .png), all points (.csv), or everything (.json)",
                 .run = [this](AppState& state) { request_export(state); },
                 .enabled = [this](const AppState&) { return task_.outcome() && task_.outcome()->error.empty(); }});
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [this](AppState& state, std::optional<uint32_t>) -> StepStatus {
      if (!state.panels.is_open(*this)) return {.error = "the panel is not open; click panel.lab first"};
      return {.done = task_.is_current(input())};
    };
    return {{.name = "lab", .check = check, .needs_frames = true}};
  }

  void report(AppState&, nlohmann::json& json) override {
    const LabOutcome* outcome = task_.outcome();
    if (!outcome) return;
    json["lab"] = {{"experiment", selected_}, {"error", outcome->error}};
    auto result = experiments::to_json(outcome->result);
    for (const char* part : {"table", "checks", "notes"}) json["lab"][part] = result[part];
    json["lab"]["charts"] = outcome->result.charts.size();
  }

  bool reveal_parameter(AppState&, const std::string& name) override {
    if (name == "lab.experiment" || name == seed_.name) return true;
    for (const Experiment& e : experiments::experiments())
      if (name.starts_with(experiment_prefix(e))) {
        selected_ = e.description.name;
        return true;
      }
    return false;
  }

  void update(AppState& state) override {
    if (state.panels.is_open(*this)) task_.update(state.task_context, input());
  }

  std::vector<Task*> tasks() override { return {&task_}; }

 private:
  const Experiment& experiment() const { return *experiments::find_experiment(selected_); }

  // The value of a parameter as it was set, or its default.
  Value value_of(const Experiment& e, const ParameterInfo& p) const {
    const auto found = values_.find(experiment_prefix(e) + p.name);
    return found == values_.end() ? p.default_value : found->second;
  }

  LabInput input() const {
    LabInput input{.experiment = selected_, .values = {}, .seed = seed_};
    for (const ParameterInfo& p : experiment().parameters) input.values.push_back(to_string(value_of(experiment(), p)));
    return input;
  }

  void request_export(AppState& state) {
    state.files.request =
        FileRequest{.title = "Export the charts (.svg, .png), points (.csv) or everything (.json)",
                    .extensions = {".svg", ".png", ".csv", ".json"},
                    .saves = true,
                    .name = selected_ + ".svg",
                    .accept = [this, &state](const std::string& file) { task_.save(state.task_context, file); }};
  }

  void draw_controls(AppState& state) {
    // The names are long, so that the list has the whole width.
    if (const auto chosen = compact_choice(state, experiment_choice(selected_), -1))
      selected_ = std::get<std::string>(*chosen);
    const Experiment& e = experiment();
    filtered_parameters(state, [&] { draw_parameters(state, e); });
    action_button(state, kExportExperiment);
    note(state.ui, e.description.summary + std::string("."));
  }

  void draw_parameters(AppState& state, const Experiment& e) {
    for (ParameterInfo p : e.parameters) {
      p.default_value = value_of(e, p);
      p.name = experiment_prefix(e) + p.name;
      if (auto value = parameter_widget(state, p)) values_[p.name] = std::move(*value);
    }
    if (const auto value = parameter_widget(state, describe(seed_))) assign(seed_, *value);
  }

  void draw_outcome(AppState& state) {
    const LabOutcome* outcome = task_.outcome();
    const float em = ImGui::GetFontSize();
    if (task_.running())
      progress_line(static_cast<float>(task_.progress()), ImGui::GetContentRegionAvail().x, 0.15f * em,
                    state.ui.theme.accent);
    if (!outcome) return note(state.ui, "Running the experiment.");
    if (!outcome->error.empty()) return warning(state.ui, "No result: " + outcome->error + ".");
    const ExperimentResult& result = outcome->result;
    const ImVec2 available = ImGui::GetContentRegionAvail();
    const bool side_by_side = available.x > kNumbersBeside * em;
    const float charts_width = side_by_side ? std::floor(0.62f * available.x) : available.x;
    const float height = std::max(available.y, 12 * em);
    ImGui::BeginGroup();
    draw_charts(state, result, {charts_width, height});
    ImGui::EndGroup();
    if (side_by_side) ImGui::SameLine(0, em);
    ImGui::BeginChild("##numbers", {0, height}, false, ImGuiWindowFlags_HorizontalScrollbar);
    for (const std::string& text : result.notes) note(state.ui, text);
    draw_table(result.table);
    draw_checks(state.ui, result.checks);
    ImGui::EndChild();
    state.ui.items.add("lab.table");
  }

  // In rows, each with the names of its curves below. More than one row scrolls.
  static void draw_charts(AppState& state, const ExperimentResult& result, const Vec2& size) {
    const float em = ImGui::GetFontSize();
    const auto count = static_cast<int>(result.charts.size());
    const int columns =
        std::clamp(static_cast<int>((size.x + em) / ((kMinChartWidth + 1) * em)), 1, std::max(count, 1));
    const bool one_row = count <= columns;
    const float scrollbar = one_row ? 0 : ImGui::GetStyle().ScrollbarSize;
    const auto gaps = static_cast<float>(columns - 1);
    const float width = std::floor((size.x - scrollbar - em * gaps) / static_cast<float>(columns));
    const float height = one_row ? size.y : std::max(kMinChartHeight * em, 0.8f * size.y);
    ImGui::BeginChild("##charts", {size.x, size.y}, false);
    for (int i = 0; i < count; ++i) {
      if (i % columns > 0) ImGui::SameLine(0, em);
      ImGui::BeginGroup();
      draw_one_chart(state, result.charts[static_cast<size_t>(i)], static_cast<size_t>(i), {width, height});
      ImGui::EndGroup();
    }
    ImGui::EndChild();
  }

  static void draw_one_chart(AppState& state, const Chart& chart, size_t index, const Vec2& size) {
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const std::vector<std::string> names = curve_names(chart);
    ImGui::TextUnformatted(shortened(heading_of(chart), size.x).c_str());
    const float legend = line * static_cast<float>(legend_lines(names, size.x));
    metrics::ChartOptions options;
    options.embedded = true;
    options.palette = lab_palette(state.ui.theme);
    const Vec2 chart_size(size.x, std::max(std::floor(size.y - legend - line), 6 * line));
    // In units of the interface, so that lines have the same width on all displays.
    options.width = static_cast<int>(chart_size.x / state.ui.scale);
    options.height = static_cast<int>(chart_size.y / state.ui.scale);
    draw_chart(state.ui, "lab.chart." + std::to_string(index), chart_size, experiments::drawing_of(chart, options));
    draw_legend(state.ui.theme, names, size.x);
  }

  // Title and axes; the drawing of a chart of errors names its axes itself.
  static std::string heading_of(const Chart& chart) {
    const auto* function = std::get_if<metrics::FunctionChart>(&chart);
    if (!function) return experiments::title_of(chart);
    return function->title + ": " + function->y_label + " over " + function->x_label;
  }

  static std::vector<std::string> curve_names(const Chart& chart) {
    std::vector<std::string> names;
    const auto add = [&](const auto& curves) {
      for (const auto& curve : curves) names.push_back(curve.name);
    };
    if (const auto* function = std::get_if<metrics::FunctionChart>(&chart)) add(function->curves);
    if (const auto* error = std::get_if<experiments::ErrorChart>(&chart)) add(error->curves);
    return names;
  }

  static float legend_width(const std::string& name) {
    return ImGui::CalcTextSize(name.c_str()).x + ImGui::GetFontSize();
  }

  static int legend_lines(const std::vector<std::string>& names, float width) {
    int lines = 1;
    float used = 0;
    for (const std::string& name : names) {
      if (used > 0 && used + legend_width(name) > width) {
        ++lines;
        used = 0;
      }
      used += legend_width(name);
    }
    return lines;
  }

  static void draw_legend(const Theme& theme, const std::vector<std::string>& names, float width) {
    float used = 0;
    for (size_t i = 0; i < names.size(); ++i) {
      const bool fits = used > 0 && used + legend_width(names[i]) <= width;
      if (fits) ImGui::SameLine(0, ImGui::GetFontSize());
      used = (fits ? used : 0) + legend_width(names[i]);
      ImGui::TextColored(text_color(metrics::method_color(i), theme), "%s", names[i].c_str());
    }
  }

  static void draw_row(const std::vector<std::string>& cells) {
    ImGui::TableNextRow();
    for (const std::string& cell : cells) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(cell.c_str());
    }
  }

  static void draw_table(const experiments::Table& table) {
    constexpr auto kFlags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersInnerH;
    if (table.columns.empty() || !ImGui::BeginTable("##table", static_cast<int>(table.columns.size()), kFlags)) return;
    draw_row(table.columns);
    for (const auto& row : table.rows) {
      std::vector<std::string> cells;
      for (const auto& cell : row) cells.push_back(experiments::cell_text(cell, 4));
      draw_row(cells);
    }
    ImGui::EndTable();
  }

  static void draw_checks(const UiContext& ui, const std::vector<experiments::Check>& checks) {
    constexpr auto kFlags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersInnerH;
    if (checks.empty() || !ImGui::BeginTable("##checks", 4, kFlags)) return;
    draw_row({"Check", "Measured", "Expected", ""});
    for (const experiments::Check& c : checks) {
      ImGui::PushStyleColor(ImGuiCol_Text, c.holds() ? ui.theme.text : ui.theme.warning);
      draw_row({c.name, formatted("%.5g", c.measured), formatted("%.5g \u00b1 %.2g", c.expected, c.tolerance),
                c.holds() ? "holds" : "does not hold"});
      ImGui::PopStyleColor();
    }
    ImGui::EndTable();
  }

  LabTask task_;
  std::string selected_ = experiments::experiments().front().description.name;
  std::map<std::string, Value> values_;  // of parameters that were set, by their full names
  Number<int> seed_ = kSeed;
};

}  // namespace

std::unique_ptr<Panel> make_lab_panel() { return std::make_unique<LabPanel>(); }

}  // namespace etendue::viewer
