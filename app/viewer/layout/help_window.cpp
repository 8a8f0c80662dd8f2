#include "viewer/layout/help_window.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viewer/state/app_state.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/dialog.h"

namespace etendue::viewer {
namespace {

constexpr ImGuiWindowFlags kHelpWindow = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                         ImGuiWindowFlags_NoNav;

constexpr float kGapBelowTitle = 6;  // pixels

struct MouseShortcut {
  const char* effect;
  const char* input;
};

constexpr MouseShortcut kMouseShortcuts[] = {
    {"Orbit", "left drag"},
    {"Pan", "middle drag, Shift+left drag"},
    {"Dolly to the pointer", "wheel"},
    {"Fly; wheel for speed", "right drag and W A S D Q E"},
    {"Turn the environment", "Shift+right drag"},
    {"Select", "click"},
    {"Focus and orbit centre", "double click"},
    {"Context menu", "right click"},
    {"Divider of A and B", "drag; double click to centre"},
    {"Show the reference", "hold Shift"},
    {"Samples of a pixel", "Ctrl+click with Sampling panel"},
    {"Enter a number", "double click"},
    {"Reset a parameter", "Ctrl+click"},
    {"Open a file", "drop it on the window"},
};

// The menus whose actions are listed. Those of the menu Help are in the menu bar and in the title of the list.
constexpr const char* kListedMenus[] = {"Integrator", "File", "Edit", "View", "Render", "Compare"};

// Actions that are only in the list of all shortcuts.
constexpr const char* kLessCommon[] = {"gizmo.local",
                                       "object.parent",
                                       "zoom.200",
                                       "object.unparent",
                                       "zoom.in",
                                       "keyframe.remove",
                                       "zoom.out",
                                       "animation.previous-frame",
                                       "file.reload",
                                       "animation.next-frame",
                                       "layout.detach",
                                       "compare.divider-left",
                                       "compare.divider-right"};

struct ShortcutRow {
  std::string effect, input;
};
struct ShortcutGroup {
  const char* heading;
  std::vector<ShortcutRow> rows;
};
using ShortcutColumn = std::span<const ShortcutGroup>;

bool is_listed(const Action& action, const char* menu) {
  return action.menu == menu && !action.shortcut.empty() &&
         std::ranges::find(kLessCommon, action.name) == std::end(kLessCommon);
}

std::vector<ShortcutGroup> shortcut_groups(const AppState& state) {
  std::vector<ShortcutGroup> groups{{.heading = "Mouse", .rows = {}}};
  for (const auto& [effect, input] : kMouseShortcuts) groups.back().rows.push_back({effect, input});
  for (const char* menu : kListedMenus) {
    groups.push_back({.heading = menu, .rows = {}});
    for (const Action& action : state.actions.all())
      if (is_listed(action, menu)) groups.back().rows.push_back({action.label, label(action.chords())});
  }
  return groups;
}

float row_height() { return std::floor(ImGui::GetFontSize() * 1.15f); }
float gap_of_groups() { return std::floor(ImGui::GetFontSize() * 0.5f); }
float gap_of_columns() { return 2 * ImGui::GetFontSize(); }

float height_of(ShortcutColumn column) {
  float height = -gap_of_groups();
  for (const ShortcutGroup& group : column)
    height += static_cast<float>(group.rows.size() + 1) * row_height() + gap_of_groups();
  return height;
}

// Groups in their order, in columns of at most this height.
std::vector<ShortcutColumn> split(ShortcutColumn groups, float height) {
  std::vector<ShortcutColumn> columns;
  for (size_t first = 0; first < groups.size();) {
    size_t count = 1;
    while (first + count < groups.size() && height_of(groups.subspan(first, count + 1)) <= height) ++count;
    columns.push_back(groups.subspan(first, count));
    first += count;
  }
  return columns;
}

// At most `count` columns, of about equal height.
std::vector<ShortcutColumn> balanced(ShortcutColumn groups, size_t count) {
  float height = row_height();
  while (split(groups, height).size() > count) height += row_height();
  return split(groups, height);
}

float help_text_width(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

// Where the inputs begin, and the width of a column.
struct ShortcutWidths {
  float inputs = 0, all = 0;
};

ShortcutWidths widths_of(ShortcutColumn column) {
  ShortcutWidths widths;
  for (const ShortcutGroup& group : column)
    for (const ShortcutRow& row : group.rows)
      widths.inputs = std::max(widths.inputs, help_text_width(row.effect) + ImGui::GetFontSize());
  for (const ShortcutGroup& group : column)
    for (const ShortcutRow& row : group.rows)
      widths.all = std::max(widths.all, widths.inputs + help_text_width(row.input));
  return widths;
}

struct HelpLayout {
  std::vector<ShortcutColumn> columns;
  ImVec2 size;  // of all columns

  explicit HelpLayout(std::vector<ShortcutColumn> list) : columns(std::move(list)), size{-gap_of_columns(), 0} {
    for (const ShortcutColumn column : columns)
      size = {size.x + widths_of(column).all + gap_of_columns(), std::max(size.y, height_of(column))};
  }
};

// As many columns as this width has room for.
HelpLayout help_layout(ShortcutColumn groups, float width) {
  constexpr size_t kMaxColumns = 3;
  for (size_t count = kMaxColumns; count > 1; --count)
    if (HelpLayout layout(balanced(groups, count)); layout.size.x <= width) return layout;
  return HelpLayout(balanced(groups, 1));
}

void draw_column(const Theme& theme, ShortcutColumn column, ImVec2 corner) {
  const float inputs = widths_of(column).inputs;
  for (const ShortcutGroup& group : column) {
    ImGui::SetCursorPos(corner);
    ImGui::TextColored(theme.accent, "%s", group.heading);
    for (const ShortcutRow& row : group.rows) {
      corner.y += row_height();
      ImGui::SetCursorPos(corner);
      ImGui::TextUnformatted(row.effect.c_str());
      ImGui::SetCursorPos({corner.x + inputs, corner.y});
      ImGui::TextDisabled("%s", row.input.c_str());
    }
    corner.y += row_height() + gap_of_groups();
  }
}

// Fills the rest of the window, and scrolls where it is smaller than the columns. Scripts find the part of the window
// that shows them as help.list, and what they fill as help.content.
void draw_columns(AppState& state, const HelpLayout& layout) {
  ImGui::BeginChild("##list", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
  ImGui::BeginGroup();
  ImVec2 corner = ImGui::GetCursorPos();
  for (const ShortcutColumn column : layout.columns) {
    draw_column(state.ui.theme, column, corner);
    corner.x += widths_of(column).all + gap_of_columns();
  }
  ImGui::EndGroup();
  const auto placement = [](const ImVec2& low, const ImVec2& size) {
    return Placement{Vec2(low.x, low.y), Vec2(size.x, size.y)};
  };
  state.ui.items.add("help.content", placement(ImGui::GetItemRectMin(), ImGui::GetItemRectSize()));
  ImVec2 size = ImGui::GetWindowSize();
  if (ImGui::GetScrollMaxY() > 0) size.x -= ImGui::GetStyle().ScrollbarSize;
  if (ImGui::GetScrollMaxX() > 0) size.y -= ImGui::GetStyle().ScrollbarSize;
  state.ui.items.add("help.list", placement(ImGui::GetWindowPos(), size));
  ImGui::EndChild();
}

void draw_help_title(AppState& state) {
  InterfaceState& interface = state.interface;
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(state.ui.theme.accent, "Keyboard and mouse shortcuts");
  ImGui::SameLine(0, 2 * ImGui::GetFontSize());
  if (ImGui::Button("Close") || escape_is_pressed()) interface.help_open = false;
  state.ui.items.add("help.close");
  ImGui::SameLine();
  if (ImGui::Button("All shortcuts...")) {
    interface.help_open = false;
    interface.preferences_open = interface.keyboard_is_requested = true;
  }
  state.ui.items.add("help.all-shortcuts");
  if (ImGui::IsItemHovered()) tooltip(state.ui, "Lists the shortcuts of all commands, and changes them");
}

}  // namespace

void draw_help(AppState& state) {
  if (!state.interface.help_open) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  const ImVec2 padding{20, 14};  // pixels
  const ImVec2 room{screen.x - em, screen.y - em};
  const std::vector<ShortcutGroup> groups = shortcut_groups(state);
  const float scrollbar = ImGui::GetStyle().ScrollbarSize + 0.5f * em;  // with a gap
  const HelpLayout layout = help_layout(groups, room.x - 2 * padding.x - scrollbar);
  const float title = ImGui::GetFrameHeightWithSpacing() + kGapBelowTitle;
  const ImVec2 size{layout.size.x + 2 * padding.x, std::ceil(layout.size.y + title + 2 * padding.y)};
  const float width = size.y > room.y ? size.x + scrollbar : size.x;
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(std::ceil(width), room.x), std::min(size.y, room.y)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::Begin("##help", nullptr, kHelpWindow);
  draw_help_title(state);
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + kGapBelowTitle);
  draw_columns(state, layout);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace etendue::viewer
