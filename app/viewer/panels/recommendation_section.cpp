#include "viewer/panels/recommendation_section.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "advisor/report_numbers.h"
#include "base/number_text.h"
#include "render/display_frame.h"
#include "viewer/actions/action.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr size_t kListed = 5;  // of the ranking, unless all are shown

// The predicted time, or why the integrator is unsuitable, in few words. The tooltip has the full reason.
std::string short_result(const advisor::Advice& advice, bool running) {
  if (!advice.suitable)
    return advice.misses.none() ? "biased" : "misses " + format_percent(advice.misses.share) + " of the light";
  if (!advice.time) return running ? "" : "unknown";
  const auto& interval = advice.time->interval;
  std::string text = advisor::seconds_text(advice.time->seconds);
  if (interval.high > interval.low)
    text += " (" + advisor::seconds_text(interval.low) + " to " + advisor::seconds_text(interval.high) + ")";
  return text;
}

}  // namespace

void RecommendationSection::draw(AppState& state) {
  if (scrolls_to_) ImGui::SetNextItemOpen(true);
  if (!group(state.ui, "Recommendation", "advice.")) return;
  if (std::exchange(scrolls_to_, false)) ImGui::SetScrollHereY(0);
  if (state.viewport.frame) task_.measure_luminance(*state.viewport.frame, state.editor->version());
  draw_parameters(state);
  const advisor::Ranking* ranking = task_.result();
  if (!ranking)
    return note(state.ui,
                "Runs a short pilot of each integrator and ranks them by the predicted time to the target "
                "error.");
  if (!task_.running() && !task_.is_current(state.document()))
    note(state.ui, "Outdated: measured before the last edit.");
  if (!task_.running() && ranking->interrupted) note(state.ui, "Cancelled: the ranking is incomplete.");
  if (!ranking->methods.empty()) draw_ranking(state, *ranking);
}

void RecommendationSection::draw_parameters(AppState& state) {
  const auto infos = task_.describe_parameters(state.document());
  if (const auto error = parameter_widget(state, infos[0])) {
    const auto target = static_cast<float>(std::get<double>(*error));
    // The default follows the document.
    task_.parameters.error = target == task_.default_target(state.document()) ? std::nullopt : std::optional(target);
  }
  if (const auto pilot = parameter_widget(state, infos[1])) assign(task_.parameters.pilot, *pilot);
  if (!task_.running()) {
    const size_t methods = advisor::candidates(state.document()).size();
    note(state.ui, formatted("Takes at most %s: a pilot for each of up to %zu methods. A shorter pilot time gives less "
                             "certain predictions.",
                             advisor::seconds_text(static_cast<double>(methods) *
                                                   static_cast<double>(task_.parameters.pilot.value))
                                 .c_str(),
                             methods));
    return action_button(state, "advice.ask");
  }
  action_button(state, "advice.stop");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  const advisor::Ranking* ranking = task_.result();
  const char* stage = ranking && !ranking->methods.empty() ? "Running pilots" : "Measuring path classes";
  note(state.ui, formatted("%s, %.0f %%", stage, 100 * task_.progress()));
}

void RecommendationSection::draw_ranking(AppState& state, const advisor::Ranking& ranking) {
  std::optional<size_t> used;
  ImGui::PushFont(state.ui.fonts.small);
  const float em = ImGui::GetFontSize();
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {em * 0.3f, std::floor(em * 0.15f)});
  if (ImGui::BeginTable("##ranking", 3, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn("method", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("method");
    ImGui::TableNextColumn();
    ImGui::TextDisabled("time to %s %s", film::measure_label(ranking.measure),
                        advisor::error_number(ranking.measure, ranking.target).c_str());
    if (ImGui::IsItemHovered()) tooltip(state.ui, "Predicted from the pilot, with the 80 % prediction interval");
    const size_t listed = shows_all_ ? ranking.methods.size() : std::min(kListed, ranking.methods.size());
    for (size_t row = 0; row < listed; ++row) {
      ImGui::PushID(static_cast<int>(row));
      if (draw_method(state, ranking.methods[row], row)) used = row;
      ImGui::PopID();
    }
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  if (ranking.methods.size() > kListed) {
    if (ImGui::SmallButton(shows_all_ ? "Show the best" : "Show all")) shows_all_ = !shows_all_;
    state.ui.items.add("advice.all");
  }
  for (const auto& light : ranking.beyond_methods) note(state.ui, "Not found by any integrator: " + light + ".");
  ImGui::PopFont();
  if (!used) return;
  task_.cancel(state.task_context);
  task_.apply(*state.editor, *used);
}

// Returns true if the method is to be used.
bool RecommendationSection::draw_method(AppState& state, const advisor::Advice& advice, size_t row) const {
  UiContext& ui = state.ui;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const ImVec4 color = advice.suitable ? ui.theme.text : ui.theme.secondary_text;
  ImGui::PushTextWrapPos(0);
  ImGui::TextColored(color, "%s", method_label(advice.method.name).c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::IsItemHovered()) tooltip(ui, advice.method.name + ": " + advice.reason);
  ImGui::TableNextColumn();
  ImGui::TextColored(advice.suitable ? color : ui.theme.warning, "%s", short_result(advice, task_.running()).c_str());
  if (ImGui::IsItemHovered()) tooltip(ui, advice.reason);
  ImGui::TableNextColumn();
  if (!advice.suitable) return false;
  const bool used = ImGui::SmallButton("Use");
  ui.items.add("advice.use." + std::to_string(row));
  if (ImGui::IsItemHovered()) tooltip(ui, "Uses this method and stops at the target error");
  return used;
}

void RecommendationSection::add_actions(ActionList& actions) {
  actions.add({.name = "advice.ask",
               .menu = "Render",
               .label = "Recommend a method",
               .tooltip = "Runs a short pilot of each integrator and ranks them by the time to the target error",
               .run =
                   [this](AppState& state) {
                     if (Panel* panel = state.panels.find("tab.render")) state.panels.open(*panel);
                     scrolls_to_ = true;
                     task_.start(state.task_context);
                   },
               .enabled = [this](const AppState& state) { return state.has_document() && !task_.running(); }});
  actions.add({.name = "advice.stop",
               .menu = "Render",
               .label = "Cancel recommendation",
               .tooltip = "Stops the pilots. The ranking of the completed pilots stays",
               .run = [this](AppState& state) { task_.cancel(state.task_context); },
               .enabled = [this](const AppState&) { return task_.running(); }});
}

std::optional<Value> RecommendationSection::default_value(const AppState& state, const std::string& name) const {
  const auto list = task_.describe_defaults(&state.document());
  const ParameterInfo* info = find_parameter(list, name);
  return info ? std::optional(info->default_value) : std::nullopt;
}

std::vector<ItemInfo> RecommendationSection::items() const {
  return {{"advice.all", "Show all", "Shows all methods of the ranking, or the best ones"},
          {"advice.use.N", "Use", "Uses method N of the ranking and stops at its target error"}};
}

WaitCondition RecommendationSection::wait_condition() {
  const auto check = [this](AppState&, std::optional<uint32_t>) -> StepStatus {
    if (task_.running()) return {};
    if (task_.result()) return {.done = true};
    return {.error = "there is no recommendation; click advice.ask first"};
  };
  return {.name = "advice", .check = check};
}

nlohmann::json RecommendationSection::report(const AppState& state) const {
  const bool is_current = state.has_document() && task_.is_current(state.document());
  nlohmann::json json{{"running", task_.running()}, {"fresh", is_current}, {"best", nullptr}};
  const advisor::Ranking* ranking = task_.result();
  if (!ranking) return json;
  json["target"] = ranking->target;
  if (const auto* best = ranking->best()) json["best"] = best->method.name;
  return json;
}

}  // namespace etendue::viewer
