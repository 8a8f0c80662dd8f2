// Text, tooltips, groups, and the arrangement of panels.
#pragma once
#include <functional>
#include <string>

#include "viewer/widgets/ui_context.h"

namespace etendue::viewer {

inline constexpr double kTooltipDelay = 0.4;  // seconds

// Shows a tooltip if the pointer has not moved for kTooltipDelay. To be called while an item is hovered.
void tooltip(const UiContext& ui, const std::string& text);

// Places the next tooltip, which has content of this size, beside the last item so that it does not cover it. At the
// pointer if there is no room, or if the pointer is outside of the item.
void place_next_tooltip(const ImVec2& content);

// Wrapped text: secondary information, and warnings.
void note(const UiContext& ui, const std::string& text);
void warning(const UiContext& ui, const std::string& text);

// The text, or its beginning and "..." if it is wider than this.
std::string shortened(std::string text, float max_width);

// A line with a label on the left and a value in monospace, which is wrapped if it is long.
void labelled_value(const UiContext& ui, const char* label, const std::string& value, const char* tooltip_text = "");

// A header that folds the widgets below it; returns whether they are visible. The group unfolds if a script requests an
// item whose name begins with `prefix`.
bool group(const UiContext& ui, const char* label, const std::string& prefix, bool open_by_default = true);

// A line of `width` at the current position, filled to this share.
void progress_line(float share, float width, float height, const ImVec4& color);

// The usual width of `controls` below, times the font size.
constexpr float kControlColumnWidth = 20;

// Continues the line if an item of this width fits.
void same_line_if_fits(float width);

// ImGui::BeginCombo with a list that fits above or below the box, so that the box stays visible.
bool begin_combo(const char* label, const char* preview, ImGuiComboFlags flags = ImGuiComboFlags_None);

// Places `controls` of this width to the right of `content`, or below it in windows of less than three times the width.
void with_controls(const UiContext& ui, float width, const std::function<void()>& content,
                   const std::function<void()>& controls);

}  // namespace etendue::viewer
