// A drawing of core/measure as a panel shows it.
#pragma once
#include <imgui.h>

#include "metrics/drawing.h"

namespace etendue::viewer {

// `corner` is where the drawing's upper left corner lies on screen, `scale` how many pixels of the screen are one of
// its own. Words are drawn in `font` as it is, whatever size they ask for: letters of another size would blur.
void draw(ImDrawList& list, const metrics::Drawing& drawing, const ImVec2& corner, float scale, ImFont* font);

ImU32 color_of(const metrics::Ink& ink);
metrics::Ink ink_of(const ImVec4& color);

}  // namespace etendue::viewer
