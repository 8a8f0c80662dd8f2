// Which method gets there first? A list of methods, and their errors as curves that grow.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "integrator/integrator.h"
#include "viewer/layout/bottom_panel.h"
#include "viewer/panels/convergence_chart.h"
#include "viewer/widgets/chart_painter.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_field.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

using Phase = bench::LiveBenchmarkSnapshot::Phase;

// A choice without a label, as wide as given.
std::optional<Value> choice_field(Workbench& w, const ParameterInfo& info, float width) {
  std::optional<Value> chosen;
  const auto& now = std::get<std::string>(info.default_value);
  const auto at = static_cast<size_t>(std::ranges::find(info.options, now) - info.options.begin());
  ImGui::PushID(info.name.c_str());
  ImGui::SetNextItemWidth(width);
  const bool open = ImGui::BeginCombo("##", info.option_labels[at].c_str());
  if (!open) describe_field(w, info);
  if (open) {
    chosen = option_list(w, info, at);
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return chosen ? chosen : from_script(w, info);
}

template <class E>
void knob(Workbench& w, Choice<E>& choice, float width) {
  if (const auto value = choice_field(w, describe(choice), width)) assign(choice, *value);
}

// To drag in: a slider so narrow would hide its figure.
template <class T>
void knob(Workbench& w, Number<T>& number, float width) {
  const ParameterInfo info = describe(number);
  ImGui::PushID(info.name.c_str());
  ImGui::SetNextItemWidth(width);
  const float speed = std::max(0.02f, 0.01f * static_cast<float>(number.value));
  if (const Change change = number_field(w, info, speed); change.value) assign(number, *change.value);
  ImGui::PopID();
}

template <class Infos>
ParameterInfo choice_of(const char* name, const char* label, const char* doc, const std::string& now,
                        const Infos& infos) {
  ParameterInfo info;
  info.name = name, info.label = label, info.doc = doc;
  info.type = ParameterType::choice;
  info.default_value = now;
  for (const auto& i : infos) info.options.push_back(i.name), info.option_labels.push_back(i.label);
  return info;
}

ParameterInfo integrator_choice(const std::string& now) {
  return choice_of("compare.integrator", "Integrator", "Of the method to be added", now,
                   integrator::integrator_infos());
}
ParameterInfo sampler_choice(const std::string& now) {
  return choice_of("compare.sampler", "Sampler", "Of the method to be added", now, sampler_infos());
}

void controls(Workbench& w) {
  ContestSetup& setup = w.contest.setup;
  const float em = ImGui::GetFontSize();
  ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
  action_button(w, w.contest.running() ? "compare.stop" : "compare.start");
  ImGui::PopStyleColor();
  if (w.contest.can_go_on()) ImGui::SameLine(), action_button(w, "compare.go-on");
  ImGui::SameLine();
  knob(w, setup.rule, em * 8.2f);
  ImGui::SameLine();
  if (setup.rule == bench::Rule::equal_time)
    knob(w, setup.seconds, em * 4.6f);
  else
    knob(w, setup.samples, em * 5.6f);
  ImGui::SameLine();
  knob(w, setup.repeats, em * 3);
}

// How much of all repeats is done, as a thin line.
void progress_line(const Workbench& w) {
  const auto* contest = w.contest.shown();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = std::max(2.0f, std::floor(2 * w.platform.scale()));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(corner, {corner.x + width, corner.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  if (contest)
    draw->AddRectFilled(corner, {corner.x + width * static_cast<float>(contest->progress), corner.y + height},
                        ImGui::GetColorU32(w.contest.running() ? w.theme.accent : w.theme.quiet));
  ImGui::Dummy({width, height});
}

struct Column {
  const char *label, *doc;
};
constexpr Column kColumns[] = {
    {"", ""},
    {"method", "As etendue bench names it"},
    {"RMSE", "Root mean square error of the first repeat's picture, without the reference's own"},
    {"slope",
     "Of the logarithm of RMSE over that of time, with its standard error over repeats: -0.5 for random numbers, "
     "steeper for good points, flat where a bias is left"},
    {"eff.", "Efficiency, 1 / (MSE x time), as a part of the best one's"},
    {"spp", "Samples per pixel of the first repeat"},
    {"s", "Seconds of rendering of the first repeat"},
    {"", ""},
};

// The small letters that choose a side of the viewport.
void side_button(Workbench& w, const char* letter, size_t row, size_t& chosen) {
  const bool on = chosen == row;
  ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(on ? ImGuiCol_Header : ImGuiCol_FrameBg));
  ImGui::PushStyleColor(ImGuiCol_Text, on ? w.theme.text : w.theme.quiet);
  if (ImGui::SmallButton(letter)) chosen = row, w.contest.choose_sides();
  ImGui::PopStyleColor(2);
  w.items.place(std::string("compare.") + (letter[0] == 'A' ? "a." : "b.") + std::to_string(row));
  if (ImGui::IsItemHovered())
    tooltip(w, letter[0] == 'A' ? "Show its picture left of the divider" : "Show its picture right of the divider");
}

void swatch(size_t place) {
  const float size = ImGui::GetFontSize() * 0.75f;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float top = at.y + (ImGui::GetTextLineHeight() - size) * 0.5f;
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + size, top + size},
                                            color_of(metrics::ink_of_method(place)), 2);
  ImGui::Dummy({size, ImGui::GetTextLineHeight()});
  ImGui::SameLine(0, size * 0.6f);
}

void cell(const std::string& text) {
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(text.c_str());
}

std::string slope_text(const metrics::Figure& slope) {
  if (!slope.known) return "?";
  return slope.degrees > 0 ? text_of("%.2f \u00b1%.2f", slope.value, slope.standard_error)
                           : text_of("%.2f", slope.value);
}

double best_efficiency(const bench::LiveBenchmarkSnapshot& contest) {
  double best = 0;
  for (const auto& m : contest.methods)
    if (m.efficiency.known) best = std::max(best, m.efficiency.value);
  return best;
}

void figures(const bench::LiveBenchmarkSnapshot& contest, const bench::Standing& m, metrics::Abscissa along) {
  const double best = best_efficiency(contest);
  cell(m.samples == 0 ? "" : m.rmse > 0 ? text_of("%.3g", m.rmse) : "< ref.");
  cell(m.samples == 0 ? "" : slope_text(along == metrics::Abscissa::seconds ? m.slope : m.slope_over_samples));
  cell(m.efficiency.known ? text_of("%.2f", m.efficiency.value / best) : "");
  cell(m.samples == 0 ? "" : text_of("%u", m.samples));
  cell(m.samples == 0 ? "" : text_of("%.1f", m.seconds));
}

// One method; true if it is to go.
bool method_row(Workbench& w, size_t row) {
  ContestSetup& setup = w.contest.setup;
  const std::string& name = setup.methods[row];
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  side_button(w, "A", row, setup.a);
  ImGui::SameLine(0, 2);
  side_button(w, "B", row, setup.b);
  ImGui::TableNextColumn();
  const auto place = w.contest.place_of(name);
  swatch(place.value_or(row));
  ImGui::TextUnformatted(spoken(name).c_str());
  if (ImGui::IsItemHovered()) tooltip(w, name);
  if (place)
    figures(*w.contest.shown(), w.contest.shown()->methods[*place], setup.along);
  else
    for (int i = 0; i < 5; ++i) cell("");
  ImGui::TableNextColumn();
  const bool removed = ImGui::SmallButton("\u00d7");
  w.items.place("compare.remove." + std::to_string(row));
  if (ImGui::IsItemHovered()) tooltip(w, "Takes the method off the list");
  return removed;
}

void headers(Workbench& w) {
  ImGui::TableNextRow();
  for (const Column& column : kColumns) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", column.label);
    if (*column.doc && ImGui::IsItemHovered()) tooltip(w, column.doc);
  }
}

void method_table(Workbench& w) {
  ImGui::PushFont(w.faces.small);
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding,
                      {ImGui::GetFontSize() * 0.4f, std::floor(ImGui::GetFontSize() * 0.2f)});
  std::optional<size_t> removed;
  if (ImGui::BeginTable("##methods", static_cast<int>(std::size(kColumns)), ImGuiTableFlags_SizingFixedFit)) {
    for (size_t i = 0; i < std::size(kColumns); ++i)
      ImGui::TableSetupColumn(kColumns[i].label,
                              i == 1 ? ImGuiTableColumnFlags_WidthStretch : ImGuiTableColumnFlags_WidthFixed);
    headers(w);
    for (size_t row = 0; row < w.contest.setup.methods.size(); ++row) {
      ImGui::PushID(static_cast<int>(row));
      if (method_row(w, row)) removed = row;
      ImGui::PopID();
    }
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  ImGui::PopFont();
  if (removed) w.contest.remove(*removed);
}

void adder(Workbench& w) {
  ContestSetup& setup = w.contest.setup;
  const float em = ImGui::GetFontSize();
  if (const auto value = choice_field(w, integrator_choice(setup.integrator), em * 8.4f))
    setup.integrator = std::get<std::string>(*value);
  ImGui::SameLine();
  if (const auto value = choice_field(w, sampler_choice(setup.sampler), em * 7.4f))
    setup.sampler = std::get<std::string>(*value);
  ImGui::SameLine();
  if (ImGui::Button("Add")) w.contest.add(setup.integrator + ":sampler=" + setup.sampler);
  w.items.place("compare.add");
  if (ImGui::IsItemHovered()) tooltip(w, "Puts this method on the list");
  ImGui::SameLine();
  action_button(w, "compare.add-current");
}

void drawn_choices(Workbench& w) {
  const float em = ImGui::GetFontSize();
  knob(w, w.contest.setup.kind, em * 6);
  ImGui::SameLine();
  knob(w, w.contest.setup.along, em * 7.6f);
  ImGui::SameLine();
  action_button(w, "compare.export");
}

// How good is what the errors are measured against?
void about_reference(Workbench& w) {
  const auto* contest = w.contest.shown();
  if (!contest) return;
  ImGui::PushFont(w.faces.small);
  std::string text =
      contest->phase == Phase::preparing ? "preparing" : text_of("repeat %d of %d", contest->repeat, contest->repeats);
  if (contest->reference)
    text += text_of("; reference: %u spp, %.1f s", contest->reference_samples, contest->reference_seconds);
  if (std::isfinite(contest->reference_error)) text += text_of(", standard error %.2g", contest->reference_error);
  note(w, text);
  if (contest->too_noisy)
    note(w,
         "That is not ten times below the smallest error: it is taken off, but the smallest differences may be its "
         "own.");
  ImGui::PopFont();
}

}  // namespace

std::vector<ParameterInfo> contest_parameters() {
  ContestSetup setup;
  auto list = describe_all(setup.knobs());
  list.push_back(integrator_choice(setup.integrator)), list.push_back(sampler_choice(setup.sampler));
  return list;
}

void draw_convergence_sheet(Workbench& w) {
  w.contest.propose();
  const float em = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x;
  const float left = std::min(std::max(width * 0.46f, em * 27), width * 0.62f);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {em * 0.4f, em * 0.25f});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {em * 0.4f, em * 0.1f});
  ImGui::BeginChild("##list", {left, 0});
  controls(w);
  progress_line(w);
  method_table(w);
  adder(w);
  drawn_choices(w);
  about_reference(w);
  ImGui::EndChild();
  ImGui::SameLine(0, em);
  ImGui::BeginChild("##chart");
  draw_convergence_chart(w);
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
}

}  // namespace etendue::viewer
