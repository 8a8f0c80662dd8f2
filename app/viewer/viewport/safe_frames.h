// Frames over the image that show which part of it other displays and crops leave visible.
#pragma once
#include <array>

#include "viewer/viewport/placement.h"

struct ImDrawList;

namespace etendue::viewer {

struct AppState;

// The action-safe and the title-safe area of an image: 93 % and 90 % of its width and height [SMPTE ST 2046-1].
std::array<Placement, 2> safe_areas(const Placement& image);

// Draws both areas and the centre of the image.
void draw_safe_frames(const AppState& state, ImDrawList& draw);

}  // namespace etendue::viewer
