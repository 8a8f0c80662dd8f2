#include "viewer/layout/command_palette.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <sstream>

#include "viewer/layout/palette_entries.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr size_t kMaxShown = 200;
constexpr const char* kSelectedItem = "palette.selected";

// Whether the text contains all words.
bool matches(const std::string& searched, const std::vector<std::string>& words) {
  return std::ranges::all_of(words, [&](const auto& word) { return searched.find(word) != std::string::npos; });
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(lower_case(text));
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// One line of the list: label, menu or section, and shortcut or value. Texts that do not fit are shortened; the tooltip
// has them in full. Returns true if it was clicked.
bool draw_entry(AppState& state, const PaletteEntry& entry, bool is_selected, bool scroll_to) {
  ImGui::PushID(entry.name.c_str());
  const float left = ImGui::GetCursorPosX(), width = ImGui::GetContentRegionAvail().x;
  const bool clicked = ImGui::Selectable("##entry", is_selected);
  state.ui.items.add("palette." + entry.name);
  if (is_selected) state.ui.items.add(kSelectedItem);
  if (scroll_to) ImGui::SetScrollHereY();
  if (ImGui::IsItemHovered()) {
    const std::string keys = entry.keys.empty() ? "" : ": " + entry.keys;
    tooltip(state.ui, entry.place + " > " + entry.label + keys + "\n" + entry.tooltip + "\n" + entry.name);
  }
  const auto column = [&](float start, float end, const std::string& text, bool is_secondary) {
    constexpr float kGap = 0.5f;  // font sizes
    ImGui::SameLine(left + width * start);
    const std::string shown = shortened(text, width * (end - start) - ImGui::GetFontSize() * kGap);
    if (is_secondary)
      ImGui::TextDisabled("%s", shown.c_str());
    else
      ImGui::TextUnformatted(shown.c_str());
  };
  column(0, 0.5f, entry.label, false);
  column(0.5f, 0.75f, entry.place, true);
  column(0.75f, 1, entry.keys, true);
  ImGui::PopID();
  return clicked;
}

bool key_pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

}  // namespace

void CommandPalette::open(AppState& state) {
  ImGui::OpenPopup("##palette");
  text_.clear();
  selected_ = 0;
  entries_ = palette_entries(state);
  labels_.clear();
  searched_.clear();
  for (const PaletteEntry& entry : entries_) labels_.push_back(lower_case(entry.label));
  for (const PaletteEntry& entry : entries_)
    searched_.push_back(lower_case(entry.label + " " + entry.name + " " + entry.place + " " + entry.tooltip));
}

std::vector<const PaletteEntry*> CommandPalette::matching() const {
  const auto words = words_of(text_);
  std::vector<const PaletteEntry*> found;
  for (const bool in_label : {true, false})
    for (size_t i = 0; i < entries_.size() && found.size() < kMaxShown; ++i)
      if (matches(searched_[i], words) && matches(labels_[i], words) == in_label) found.push_back(&entries_[i]);
  return found;
}

void CommandPalette::draw(AppState& state) {
  bool& is_open = state.interface.palette_open;
  if (is_open && !ImGui::IsPopupOpen("##palette")) open(state);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({screen.x / 2, screen.y * 0.12f}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSize({std::min(screen.x * 0.9f, em * 36), std::min(screen.y * 0.7f, em * 24)});
  if (!ImGui::BeginPopup("##palette")) {
    is_open = false;
    entries_.clear();
    return;
  }
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputTextWithHint("##text", "Find a command, a parameter or a value", &text_,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemEdited()) selected_ = 0;
  const auto found = matching();
  const size_t before = selected_;
  if (key_pressed(ImGuiKey_DownArrow) && selected_ + 1 < found.size()) ++selected_;
  if (key_pressed(ImGuiKey_UpArrow) && selected_ > 0) --selected_;
  const PaletteEntry* chosen = entered && selected_ < found.size() ? found[selected_] : nullptr;
  ImGui::BeginChild("##found");
  ImGui::SetCursorPosY(ImGui::GetStyle().ItemSpacing.y / 2);  // by which the background of an entry is higher
  for (size_t i = 0; i < found.size(); ++i)
    if (draw_entry(state, *found[i], i == selected_, i == selected_ && selected_ != before)) chosen = found[i];
  if (found.empty()) ImGui::TextDisabled("No matching command");
  ImGui::EndChild();
  if (chosen || key_pressed(ImGuiKey_Escape)) {
    is_open = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  if (!chosen) return;
  const auto run = chosen->run;
  run(state);
}

}  // namespace etendue::viewer
