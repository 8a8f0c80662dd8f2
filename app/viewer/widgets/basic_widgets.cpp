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

namespace {

// Places the next tooltip below the last item, or above it in the lower half of the window, so that it does not cover
// the item. Next to the pointer if the item is larger than a few lines.
void place_tooltip(const std::string& text, float wrap_width) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  if (high.y - low.y > ImGui::GetFrameHeight() * 2) return;
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const float width = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap_width).x + 2 * padding.x;
  const float gap = ImGui::GetFontSize() * 0.3f;
  const bool above = low.y > screen.y / 2;
  const float left = std::min(std::max(low.x, ImGui::GetMousePos().x - width / 2), screen.x - width - gap);
  ImGui::SetNextWindowPos({std::max(0.0f, left), above ? low.y - gap : high.y + gap}, ImGuiCond_Always,
                          {0, above ? 1.0f : 0.0f});
}

}  // namespace

void tooltip(const UiContext& ui, const std::string& text) {
  if (ui.pointer_rest < kTooltipDelay || text.empty()) return;
  ImGui::PushFont(ui.fonts.text);
  const float wrap_width = ImGui::GetFontSize() * kTooltipWidth;
  place_tooltip(text, wrap_width);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(wrap_width);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopFont();
}

void same_line_if_fits(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
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
  bool hovered = ImGui::IsItemHovered();
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
