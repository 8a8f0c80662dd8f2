// Which light paths does the energy of this view come by, and which of them does the method find?
#include <imgui.h>

#include <algorithm>

#include "advisor/number_text.h"
#include "viewer/layout/bottom_panel.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

using Finds = MethodView::Finds;

struct Column {
  const char *label, *doc;
};
constexpr Column kColumns[] = {
    {"paths",
     "A class of light paths, read from the eye to the light. Click one to see what it carries; click again for all"},
    {"share", "Of the light in this view"},
    {"energy", "Mean luminance over the picture, W/(m^2 sr), with its standard error"},
    {"found", "Whether the method of the Render panel finds these paths"},
};

constexpr const char* kLetters =
    "E eye, D diffuse, G glossy, S mirror or glass, L light; + once or more, * any number, . any surface, | or";

// "EDS+L" as "eye, diffuse, mirror or glass (once or more), light".
std::string in_words(const std::string& paths) {
  std::string words;
  bool joins = true;  // no comma comes before the next word
  const auto word = [&](const char* text) { words += (joins ? "" : ", ") + std::string(text), joins = false; };
  for (const char c : paths) {
    if (c == 'E') word("eye");
    if (c == 'D') word("diffuse");
    if (c == 'G') word("glossy");
    if (c == 'S') word("mirror or glass");
    if (c == 'L') word("light");
    if (c == '.') word("anything");
    if (c == '(') word("("), joins = true;
    if (c == ')') words += ")";
    if (c == '|') words += " or ", joins = true;
    if (c == '+') words += " (once or more)";
    if (c == '*') words += " (any number of times)";
    if (c == '?') words += " (or not)";
  }
  return words;
}

// The share as a bar with its figure on it.
void share_bar(const Workbench& w, double share, float width) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight(), figure_width = ImGui::GetFontSize() * 4.8f,
              room = width - figure_width;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({at.x, at.y + 2}, {at.x + room, at.y + height - 2}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  draw->AddRectFilled({at.x, at.y + 2},
                      {at.x + room * static_cast<float>(std::clamp(share, 0.0, 1.0)), at.y + height - 2},
                      ImGui::GetColorU32(w.theme.accent));
  const std::string text = advisor::percent(share);
  draw->AddText({at.x + width - ImGui::CalcTextSize(text.c_str()).x, at.y}, ImGui::GetColorU32(ImGuiCol_Text),
                text.c_str());
  ImGui::Dummy({width, height});
}

void energy_cell(const Workbench& w, const advisor::ClassEnergy& energy) {
  ImGui::Text("%s \u00b1 %s", advisor::number(energy.mean).c_str(), text_of("%.2g", energy.standard_error).c_str());
  if (!energy.uncertain()) return;
  ImGui::SameLine();
  ImGui::TextColored(w.theme.warning, "uncertain");
  if (ImGui::IsItemHovered())
    tooltip(w, "Few samples found these paths: the truth may be far from this number, most likely above it");
}

void found_cell(const Workbench& w, Finds finds) {
  if (finds == Finds::all) return ImGui::TextUnformatted("yes");
  ImGui::TextColored(w.theme.warning, finds == Finds::part ? "in part" : "no");
}

void share_and_energy(const Workbench& w, const advisor::ClassRow& row, float bar) {
  ImGui::TableNextColumn();
  share_bar(w, row.share, bar);
  ImGui::TableNextColumn();
  energy_cell(w, row.energy);
  ImGui::TableNextColumn();
}

// One class. A click has it alone count.
void class_row(Workbench& w, const advisor::ClassRow& row, size_t index, float bar) {
  const bool chosen = w.editor.document().method.paths == row.paths;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (ImGui::Selectable(row.paths.c_str(), chosen,
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap))
    w.choose_paths(chosen ? "" : row.paths);
  w.items.place("paths.row." + std::to_string(index));
  if (ImGui::IsItemHovered()) tooltip(w, row.paths + ": " + in_words(row.paths));
  share_and_energy(w, row, bar);
  found_cell(w, w.paths.seen().rows[index]);
}

void total_row(Workbench& w, const advisor::ClassTable& table, float bar) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted("all paths");
  share_and_energy(w, table.total, bar);
  const double missed = w.paths.seen().misses.share;
  if (missed > 0)
    ImGui::TextColored(w.theme.warning, "%s", advisor::percent(1 - missed).c_str());
  else
    ImGui::TextUnformatted("all");
}

void class_table(Workbench& w, const PathsTable& shown) {
  const float em = ImGui::GetFontSize(), bar = em * 13;
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {em * 0.5f, std::floor(em * 0.12f)});
  if (ImGui::BeginTable("##classes", static_cast<int>(std::size(kColumns)),
                        ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollY)) {
    for (const Column& column : kColumns)
      ImGui::TableSetupColumn(
          column.label, &column == kColumns ? ImGuiTableColumnFlags_WidthStretch : ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableNextRow();
    for (const Column& column : kColumns) {
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", column.label);
      if (ImGui::IsItemHovered()) tooltip(w, column.doc);
    }
    for (size_t i = 0; i < shown.table.rows.size(); ++i) class_row(w, shown.table.rows[i], i, bar);
    total_row(w, shown.table, bar);
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
}

// What the table says of the method, and what it cannot say.
void remarks(Workbench& w) {
  action_button(w, "paths.measure");
  ImGui::SameLine();
  action_button(w, "paths.all");
  ImGui::PushFont(w.faces.small);
  const auto* shown = w.paths.shown();
  if (const auto& chosen = w.editor.document().method.paths; !chosen.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, w.theme.accent);
    ImGui::TextWrapped("The picture is of %s alone.", chosen.c_str());
    ImGui::PopStyleColor();
  }
  if (w.paths.running()) note(w, "Measuring.");
  if (shown && !w.paths.fresh()) warning(w, "Of the view before the last edit.");
  if (shown) {
    const auto& misses = w.paths.seen().misses;
    const std::string sentence = w.editor.document().method.integrator + " " + advisor::sentence_of(misses) + ".";
    misses.none() ? ImGui::TextWrapped("%s", sentence.c_str()) : warning(w, sentence);
    for (const auto& beyond : shown->beyond_methods) warning(w, "Beyond all methods: " + beyond + ".");
    if (!shown->table.unseen.empty()) {
      std::string unseen = "No sample found light by";
      for (const auto& paths : shown->table.unseen) unseen += "  " + paths;
      note(w, unseen + ".");
    }
    note(w, text_of("%d x %d pixels, %u spp, %.1f s.", shown->table.width, shown->table.height, shown->table.samples,
                    shown->table.seconds));
  }
  ImGui::Spacing();
  note(w, kLetters);
  ImGui::PopFont();
}

}  // namespace

void draw_paths_sheet(Workbench& w) {
  const float em = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {em * 0.4f, em * 0.25f});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {em * 0.4f, em * 0.1f});
  ImGui::BeginChild("##table", {std::floor(width * 0.66f), 0});
  ImGui::PushFont(w.faces.small);
  if (const auto* shown = w.paths.shown())
    class_table(w, *shown);
  else
    note(w, w.paths.running() ? "Small pictures of path classes are being made."
                              : "Nothing was measured of this view yet.");
  ImGui::PopFont();
  ImGui::EndChild();
  ImGui::SameLine(0, em);
  ImGui::BeginChild("##remarks");
  remarks(w);
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
}

}  // namespace etendue::viewer
