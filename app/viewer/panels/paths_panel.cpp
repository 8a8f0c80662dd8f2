// The energy of each class of light paths, and which of them the integrator finds.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "advisor/report_numbers.h"
#include "render/document.h"
#include "viewer/actions/action.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/tasks/exclusive_task.h"
#include "viewer/tasks/path_class_task.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using Found = IntegratorCoverage::Found;

constexpr const char* kPathFilter = "film.paths";

struct Column {
  const char* label;
  const char* tooltip;
};
constexpr Column kColumns[] = {
    {"path class",
     "A class of light paths as an expression from the camera to the light. Click a class to render only these paths; "
     "click again for all paths"},
    {"share", "Share of the light in this view"},
    {"luminance", "Mean luminance over the image with its standard error, cd/m\u00b2"},
    {"found", "Whether the current integrator finds these paths"},
};

constexpr const char* kLegend =
    "E camera, D diffuse, G glossy, S specular, L light; . any surface, + once or more, * any number of times, | or";

// "EDS+L" as "camera, diffuse, specular (once or more), light".
std::string describe_expression(const std::string& expression) {
  std::string text;
  bool needs_comma = false;
  const auto add_word = [&](const char* word) {
    text += (needs_comma ? ", " : "") + std::string(word);
    needs_comma = true;
  };
  for (const char c : expression) {
    switch (c) {
      case 'E':
        add_word("camera");
        break;
      case 'D':
        add_word("diffuse");
        break;
      case 'G':
        add_word("glossy");
        break;
      case 'S':
        add_word("specular");
        break;
      case 'L':
        add_word("light");
        break;
      case '.':
        add_word("any surface");
        break;
      case '(':
        add_word("(");
        needs_comma = false;
        break;
      case ')':
        text += ")";
        break;
      case '|':
        text += " or ";
        needs_comma = false;
        break;
      case '+':
        text += " (once or more)";
        break;
      case '*':
        text += " (any number of times)";
        break;
      case '?':
        text += " (optional)";
        break;
      default:
        break;
    }
  }
  return text;
}

float share_width() { return ImGui::GetFontSize() * 13; }

// A bar with the percentage next to it.
void share_bar(const UiContext& ui, double share, const std::string& text, float width) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight();
  const float bar_width = width - ImGui::GetFontSize() * 4.8f;
  const auto filled = static_cast<float>(std::clamp(share, 0.0, 1.0));
  const float top = corner.y + 2;
  const float bottom = corner.y + height - 2;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({corner.x, top}, {corner.x + bar_width, bottom}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  draw->AddRectFilled({corner.x, top}, {corner.x + bar_width * filled, bottom}, ImGui::GetColorU32(ui.theme.accent));
  draw->AddText({corner.x + width - ImGui::CalcTextSize(text.c_str()).x, corner.y}, ImGui::GetColorU32(ImGuiCol_Text),
                text.c_str());
  ImGui::Dummy({width, height});
}

void luminance_cell(const UiContext& ui, const advisor::ClassEnergy& energy) {
  ImGui::Text("%s \u00b1 %.2g", advisor::number(energy.mean).c_str(), energy.standard_error);
  if (!energy.uncertain()) return;
  ImGui::SameLine();
  ImGui::TextColored(ui.theme.warning, "uncertain");
  if (ImGui::IsItemHovered())
    tooltip(ui, "Few samples found these paths. The true value may differ a lot; it is most likely higher");
}

void found_cell(const UiContext& ui, Found found) {
  if (found == Found::all) return ImGui::TextUnformatted("yes");
  ImGui::TextColored(ui.theme.warning, found == Found::part ? "in part" : "no");
}

void share_and_luminance_cells(const UiContext& ui, const advisor::ClassRow& row, const std::string& share,
                               float bar_width) {
  ImGui::TableNextColumn();
  share_bar(ui, row.share, share, bar_width);
  ImGui::TableNextColumn();
  luminance_cell(ui, row.energy);
  ImGui::TableNextColumn();
}

class PathsPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.paths",
            .label = "Paths",
            .description = "Energy of each class of light paths in this view, and which of them the integrator finds",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    const float em = ImGui::GetFontSize();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {em * 0.4f, em * 0.25f});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {em * 0.4f, em * 0.1f});
    ImGui::BeginChild("##table", {std::floor(width * 0.66f), 0});
    ImGui::PushFont(state.ui.fonts.small);
    const PathClassTask& task = *state.tasks.path_classes;
    if (const PathClasses* classes = task.result())
      draw_table(state, *classes);
    else
      note(state.ui, task.running() ? "Measuring path classes." : "This view was not measured yet.");
    ImGui::PopFont();
    ImGui::EndChild();
    ImGui::SameLine(0, em);
    ImGui::BeginChild("##remarks");
    draw_remarks(state);
    ImGui::EndChild();
    ImGui::PopStyleVar(2);
  }

  std::vector<ItemInfo> items() const override {
    return {
        {"paths.row.N", "Path class N", "Renders only the paths of row N; all paths if these are rendered already"}};
  }

  void add_actions(ActionList& actions) override {
    actions.add({.name = "paths.measure",
                 .menu = "Render",
                 .label = "Measure path classes",
                 .tooltip = "Measures the energy of each class of light paths in this view",
                 .run =
                     [this](AppState& state) {
                       state.panels.open(*this);
                       state.tasks.path_classes->start(state.task_context);
                     },
                 .enabled =
                     [](const AppState& state) {
                       return state.has_document() && !state.tasks.exclusive->measures_path_classes();
                     }});
    actions.add(
        {.name = "paths.all",
         .menu = "Render",
         .label = "All paths",
         .tooltip = "Removes the path filter: all light paths are rendered",
         .run = [](AppState& state) { state.set_parameter(kPathFilter, std::string()); },
         .enabled =
             [](const AppState& state) { return state.has_document() && !state.document().method.paths.empty(); }});
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [](AppState& state, std::optional<uint32_t>) -> StepStatus {
      const PathClassTask& task = *state.tasks.path_classes;
      if (task.running()) return {};
      if (task.is_current(state.document())) return {.done = true};
      return {.error = "the path classes of this view were not measured; click paths.measure first"};
    };
    return {{"paths", check}};
  }

  void report(AppState& state, nlohmann::json& json) override {
    PathClassTask& task = *state.tasks.path_classes;
    auto& paths = json["paths"];
    paths = {{"fresh", state.has_document() && task.is_current(state.document())},
             {"running", task.running()},
             {"rows", nlohmann::json::array()}};
    if (!task.result()) return;
    constexpr const char* kFoundNames[] = {"yes", "in part", "no"};
    const auto& rows = task.result()->table.rows;
    const IntegratorCoverage& coverage = task.coverage(state.task_context);
    for (size_t i = 0; i < rows.size(); ++i)
      paths["rows"].push_back({{"paths", rows[i].paths},
                               {"share", rows[i].share},
                               {"found", kFoundNames[static_cast<size_t>(coverage.rows[i])]}});
    paths["missing_share"] = coverage.missing_paths.share;
  }

  void update(AppState& state) override {
    const bool allowed = state.panels.is_open(*this) && !state.tasks.exclusive->measures_path_classes();
    state.tasks.path_classes->update(state.task_context, allowed);
  }

 private:
  static void draw_table(AppState& state, const PathClasses& classes) {
    const float em = ImGui::GetFontSize();
    const advisor::ClassTable& table = classes.table;
    const IntegratorCoverage& coverage = state.tasks.path_classes->coverage(state.task_context);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {em * 0.5f, std::floor(em * 0.12f)});
    if (ImGui::BeginTable("##classes", static_cast<int>(std::size(kColumns)),
                          ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollY)) {
      draw_header(state.ui);
      const std::vector<std::string> shares = advisor::percents(table.shares());
      for (size_t i = 0; i < table.rows.size(); ++i) draw_row(state, i, table.rows[i], shares[i], coverage.rows[i]);
      draw_total(state.ui, table, coverage.missing_paths.share);
      ImGui::EndTable();
    }
    ImGui::PopStyleVar();
  }

  static void draw_header(const UiContext& ui) {
    for (const Column& column : kColumns)
      ImGui::TableSetupColumn(
          column.label, &column == kColumns ? ImGuiTableColumnFlags_WidthStretch : ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableNextRow();
    for (const Column& column : kColumns) {
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", column.label);
      if (ImGui::IsItemHovered()) tooltip(ui, column.tooltip);
    }
  }

  static void draw_row(AppState& state, size_t index, const advisor::ClassRow& row, const std::string& share,
                       Found found) {
    const bool selected = state.document().method.paths == row.paths;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool clicked = ImGui::Selectable(row.paths.c_str(), selected,
                                           ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap);
    state.ui.items.add("paths.row." + std::to_string(index));
    if (ImGui::IsItemHovered()) tooltip(state.ui, row.paths + ": " + describe_expression(row.paths));
    share_and_luminance_cells(state.ui, row, share, share_width());
    found_cell(state.ui, found);
    if (clicked) state.set_parameter(kPathFilter, selected ? std::string() : row.paths);
  }

  static void draw_total(const UiContext& ui, const advisor::ClassTable& table, double missing_share) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted("all paths");
    share_and_luminance_cells(ui, table.total, format_percent(table.total.share), share_width());
    if (missing_share > 0)
      ImGui::TextColored(ui.theme.warning, "%s", format_percent(1 - missing_share).c_str());
    else
      ImGui::TextUnformatted("all");
  }

  // Actions, and what the table does not show.
  static void draw_remarks(AppState& state) {
    const UiContext& ui = state.ui;
    action_button(state, "paths.measure");
    ImGui::SameLine();
    action_button(state, "paths.all");
    ImGui::PushFont(ui.fonts.small);
    if (const auto& filter = state.document().method.paths; !filter.empty()) {
      ImGui::PushStyleColor(ImGuiCol_Text, ui.theme.accent);
      ImGui::TextWrapped("Path filter: only %s is rendered.", filter.c_str());
      ImGui::PopStyleColor();
    }
    PathClassTask& task = *state.tasks.path_classes;
    if (task.running()) note(ui, "Measuring.");
    if (const PathClasses* classes = task.result()) {
      if (!task.is_current(state.document())) warning(ui, "Outdated: measured before the last edit.");
      draw_coverage(state, *classes, task.coverage(state.task_context));
    }
    ImGui::Spacing();
    note(ui, kLegend);
    ImGui::PopFont();
  }

  static void draw_coverage(const AppState& state, const PathClasses& classes, const IntegratorCoverage& coverage) {
    const UiContext& ui = state.ui;
    const std::string sentence = integrator_label(state.document().method.integrator) + " " +
                                 advisor::missing_paths_text(coverage.missing_paths) + ".";
    if (coverage.missing_paths.none())
      ImGui::TextWrapped("%s", sentence.c_str());
    else
      warning(ui, sentence);
    for (const auto& light : classes.beyond_methods) warning(ui, "Not found by any integrator: " + light + ".");
    const advisor::ClassTable& table = classes.table;
    if (!table.unseen.empty()) {
      std::string text = "Classes without any sample:";
      for (const auto& paths : table.unseen) text += "  " + paths;
      note(ui, text + ".");
    }
    note(ui, formatted("Measured at %d x %d pixels, %u spp, %.1f s.", table.width, table.height, table.samples,
                       table.seconds));
  }
};

}  // namespace

std::unique_ptr<Panel> make_paths_panel() { return std::make_unique<PathsPanel>(); }

}  // namespace etendue::viewer
