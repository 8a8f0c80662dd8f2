// Which method should be used here? The question and the ranking, in the Render panel.
#include <imgui.h>

#include "advisor/number_text.h"
#include "viewer/layout/interface.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

void question(Workbench& w) {
  const auto knobs = advice_parameters(&w.advice);
  if (const auto error = loose_widget(w, knobs[0])) w.advice.setup.error = static_cast<float>(std::get<double>(*error));
  if (const auto pilot = loose_widget(w, knobs[1])) assign(w.advice.setup.pilot, *pilot);
  if (!w.advice.running()) return action_button(w, "advice.ask");
  action_button(w, "advice.stop");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  const auto* ranking = w.advice.shown();
  note(w, text_of("%s, %.0f %%", ranking && !ranking->methods.empty() ? "Trying methods out" : "Measuring path classes",
                  100 * w.advice.progress()));
}

// In few words; the whole reason comes when the pointer rests on it.
std::string verdict(const advisor::Advice& a, bool running) {
  if (!a.suitable) return a.misses.none() ? "biased" : "misses " + advisor::percent(a.misses.share);
  if (!a.time) return running ? "" : "unknown";
  const auto& interval = a.time->interval;
  std::string text = advisor::seconds_text(a.time->seconds);
  if (interval.high > interval.low)
    text += " (" + advisor::seconds_text(interval.low) + " to " + advisor::seconds_text(interval.high) + ")";
  return text;
}

// True if the method is to be used.
bool method_row(Workbench& w, const advisor::Advice& a, size_t row) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const ImVec4 color = a.suitable ? w.theme.text : w.theme.quiet;
  ImGui::TextColored(color, "%s", spoken(a.method.name).c_str());
  if (ImGui::IsItemHovered()) tooltip(w, a.method.name + ": " + a.reason);
  ImGui::TableNextColumn();
  ImGui::TextColored(a.suitable ? color : w.theme.warning, "%s", verdict(a, w.advice.running()).c_str());
  if (ImGui::IsItemHovered()) tooltip(w, a.reason);
  ImGui::TableNextColumn();
  if (!a.suitable) return false;
  const bool used = ImGui::SmallButton("Use");
  w.items.place("advice.use." + std::to_string(row));
  if (ImGui::IsItemHovered()) tooltip(w, "Takes this method, and the error as the limit to stop at");
  return used;
}

void ranking_table(Workbench& w, const advisor::Ranking& ranking) {
  std::optional<size_t> used;
  ImGui::PushFont(w.faces.small);
  const float em = ImGui::GetFontSize();
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {em * 0.3f, std::floor(em * 0.15f)});
  if (ImGui::BeginTable("##ranking", 3, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn("method", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("method");
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", ("time to RMSE " + advisor::number(ranking.target)).c_str());
    if (ImGui::IsItemHovered())
      tooltip(w, "Foretold from a short trial, with the interval that should hold it in 80 of 100 cases");
    for (size_t row = 0; row < ranking.methods.size(); ++row) {
      ImGui::PushID(static_cast<int>(row));
      if (method_row(w, ranking.methods[row], row)) used = row;
      ImGui::PopID();
    }
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  for (const auto& beyond : ranking.beyond_methods) note(w, "Beyond all methods: " + beyond + ".");
  ImGui::PopFont();
  if (used) w.advice.stop(), w.advice.use(*used);
}

}  // namespace

void draw_advice(Workbench& w) {
  if (!group(w, "Advice", "advice.")) return;
  if (w.frame) w.advice.look_at(*w.frame);
  question(w);
  const auto* ranking = w.advice.shown();
  if (!ranking)
    return note(w, "Tries every method out for a moment, and ranks them by the time they need to this error.");
  if (!w.advice.running() && !w.advice.fresh()) note(w, "Of the scene before the last edit.");
  if (!w.advice.running() && ranking->interrupted) note(w, "Called off: as far as it came.");
  if (!ranking->methods.empty()) ranking_table(w, *ranking);
}

}  // namespace etendue::viewer
