#include "viewer/widgets/basic_widgets.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/widgets/number_widget.h"

namespace etendue::viewer {
namespace {

constexpr float kTooltipWidth = 24;  // times the font size

void wrapped_text(const std::string& text, const ImVec4& color) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

}  // namespace

void tooltip(const UiContext& ui, const std::string& text) {
  if (ui.pointer_rest < kTooltipDelay || text.empty()) return;
  ImGui::PushFont(ui.fonts.text);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * kTooltipWidth);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopFont();
}

void note(const UiContext& ui, const std::string& text) { wrapped_text(text, ui.theme.secondary_text); }

void warning(const UiContext& ui, const std::string& text) { wrapped_text(text, ui.theme.warning); }

void labelled_value(const UiContext& ui, const char* label, const std::string& value, const char* tooltip_text) {
  ImGui::TextDisabled("%s", label);
  bool hovered = ImGui::IsItemHovered();
  continue_after_label(ImGui::GetItemRectSize().x);
  ImGui::PushFont(ui.fonts.monospace);
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopFont();
  hovered = hovered || ImGui::IsItemHovered();
  if (hovered) tooltip(ui, tooltip_text);
}

bool group(const UiContext& ui, const char* label, const std::string& prefix, bool open_by_default) {
  const bool is_requested = !prefix.empty() && ui.items.is_requested_below(prefix);
  const bool is_pointed_out = !prefix.empty() && ui.items.pointed_out().starts_with(prefix);
  if (is_requested || is_pointed_out || !ui.filter.empty()) ImGui::SetNextItemOpen(true);
  ImGui::Spacing();
  // Darker than a selected row.
  ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
  const bool visible = ImGui::CollapsingHeader(label, open_by_default ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  ImGui::PopStyleColor();
  return visible;
}

void progress_line(float share, float width, float height, const ImVec4& color) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(corner, {corner.x + width, corner.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  draw->AddRectFilled(corner, {corner.x + width * share, corner.y + height}, ImGui::GetColorU32(color));
  ImGui::Dummy({width, height});
}

void with_controls(const UiContext& ui, float width, const std::function<void()>& content,
                   const std::function<void()>& controls) {
  const float available = ImGui::GetContentRegionAvail().x;
  const float gap = ImGui::GetFontSize();
  const bool side_by_side = available > 3 * width;
  if (side_by_side) ImGui::BeginChild("##content", {std::floor(available - width - gap), 0});
  ImGui::PushFont(ui.fonts.small);
  content();
  ImGui::PopFont();
  if (!side_by_side) {
    controls();
    return;
  }
  ImGui::EndChild();
  ImGui::SameLine(0, gap);
  ImGui::BeginChild("##controls");
  controls();
  ImGui::EndChild();
}

}  // namespace etendue::viewer
