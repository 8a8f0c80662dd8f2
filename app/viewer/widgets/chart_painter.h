// Draws the charts of lab/metrics with Dear ImGui.
#pragma once
#include <imgui.h>

#include <string>

#include "metrics/convergence_chart.h"
#include "metrics/drawing.h"
#include "viewer/widgets/ui_context.h"

namespace etendue::viewer {

// `corner` is the upper left corner of the drawing on screen. One unit of the drawing is one unit of the interface. Text
// has the size of the small font, independent of the size in the drawing, because scaled glyphs would be blurred.
void paint(const UiContext& ui, ImDrawList& list, const metrics::Drawing& drawing, const ImVec2& corner);

// Draws a chart as an item of this size and name. Returns true while it is dragged.
bool draw_chart(UiContext& ui, const std::string& name, const Vec2& size, const metrics::Drawing& drawing);

// The colours of the axes of charts in this theme.
metrics::ChartPalette chart_palette(const Theme& theme);

ImU32 color_of(const metrics::Color& color);
// A colour for text: mixed with the text colour of the theme if its contrast with a panel is below 4.5 (WCAG 2.1).
ImVec4 text_color(const metrics::Color& color, const Theme& theme);
metrics::Color chart_color(const ImVec4& color);

}  // namespace etendue::viewer
