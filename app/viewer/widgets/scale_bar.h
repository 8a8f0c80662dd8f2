// Labels and colour scales over the image.
#pragma once
#include <imgui.h>

#include <span>
#include <string>

#include "spectrum/rgb.h"
#include "viewer/viewport/placement.h"

namespace etendue::viewer {

struct UiContext;

// A colour scale in the upper right corner of the image. `color` maps 0..1 to sRGB; the labels are evenly spaced.
void draw_scale_bar(const UiContext& ui, ImDrawList* draw, const Placement& image, Rgb (*color)(float),
                    std::span<const std::string> labels, const char* title);

// Text on a background that is legible over any image. `corner` is the upper left one. Returns the size.
Vec2 draw_label(ImDrawList* draw, Vec2 corner, const std::string& text);
Vec2 label_size(const std::string& text);
// The text with line breaks between words, so that its label is not wider than this.
std::string wrapped_label(const std::string& text, float width);

}  // namespace etendue::viewer
