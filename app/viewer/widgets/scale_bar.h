// The key to a picture in false colours: a bar with figures below it.
#pragma once
#include <imgui.h>

#include <span>
#include <string>

#include "viewer/state/app_state.h"

namespace etendue::viewer {

// In the upper right corner of the picture. `color` takes 0 to 1, the figures are spread evenly over it.
void draw_scale_bar(const Workbench& w, ImDrawList* draw, Rgb (*color)(float), std::span<const std::string> figures,
                    const char* title);

// Words on a ground of their own that are legible on any picture. `corner` is the upper left; returns the size.
Vec2 draw_label(ImDrawList* draw, Vec2 corner, const std::string& text);
Vec2 label_size(const std::string& text);

}  // namespace etendue::viewer
