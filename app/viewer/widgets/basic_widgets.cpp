#include "viewer/widgets/basic_widgets.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "viewer/widgets/number_widget.h"
#include "viewer/widgets/tooltip_corner.h"

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

void place_next_tooltip(const ImVec2& content) {
  const ImDrawList& draw = *ImGui::GetWindowDrawList();
  const auto rectangle = [](const ImVec2& low, const ImVec2& high) {
    return Placement{Vec2(low.x, low.y), Vec2(high.x - low.x, high.y - low.y)};
  };
  const Placement item = rectangle(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
  const Placement visible = intersection(item, rectangle(draw.GetClipRectMin(), draw.GetClipRectMax()));
  const ImVec2 mouse = ImGui::GetMousePos(), screen = ImGui::GetIO().DisplaySize;
  const Vec2 pointer(mouse.x, mouse.y);
  if (!visible.contains(pointer)) return;
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const Vec2 size = Vec2(content.x, content.y) + 2.0f * Vec2(padding.x, padding.y);
  const float gap = ImGui::GetFontSize() * 0.3f;
  if (const auto corner = tooltip_corner(visible, size, {screen.x, screen.y}, pointer, gap))
    ImGui::SetNextWindowPos({corner->x, corner->y});
}

void tooltip(const UiContext& ui, const std::string& text) {
  if (ui.pointer_rest < kTooltipDelay || text.empty()) return;
  ImGui::PushFont(ui.fonts.text);
  const float wrap_width = ImGui::GetFontSize() * kTooltipWidth;
  place_next_tooltip(ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap_width));
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap_width);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopFont();
}

void same_line_if_fits(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

bool begin_combo(const char* label, const char* preview, ImGuiComboFlags flags) {
  const float top = ImGui::GetCursorScreenPos().y, bottom = top + ImGui::GetFrameHeight();
  const float margin = 2 * ImGui::GetStyle().DisplaySafeAreaPadding.y;
  const float room = std::max(top, ImGui::GetIO().DisplaySize.y - bottom) - margin;
  ImGui::SetNextWindowSizeConstraints({0, 0}, {FLT_MAX, room});
  return ImGui::BeginCombo(label, preview, flags);
}

void note(const UiContext& ui, const std::string& text) { wrapped_text(text, ui.theme.secondary_text); }

void warning(const UiContext& ui, const std::string& text) { wrapped_text(text, ui.theme.warning); }

std::string shortened(std::string text, float max_width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= max_width) return text;
  const auto is_continuation = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };  // of UTF-8
  while (!text.empty() && ImGui::CalcTextSize((text + "...").c_str()).x > max_width) {
    while (text.size() > 1 && is_continuation(text.back())) text.pop_back();
    text.pop_back();
  }
  return text + "...";
}

void labelled_value(const UiContext& ui, const char* label, const std::string& value, const char* tooltip_text) {
  ImGui::TextDisabled("%s", label);
  if (ImGui::IsItemHovered()) tooltip(ui, tooltip_text);
  continue_after_label(ImGui::GetItemRectSize().x);
  ImGui::PushFont(ui.fonts.monospace);
  // A long value is wrapped, in the next line if there is hardly any room beside the label.
  constexpr float kLeastRoom = 8;  // font sizes
  const float room = ImGui::GetContentRegionAvail().x;
  if (ImGui::CalcTextSize(value.c_str()).x > room && room < kLeastRoom * ImGui::GetFontSize()) ImGui::NewLine();
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopFont();
  if (ImGui::IsItemHovered()) tooltip(ui, tooltip_text);
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
