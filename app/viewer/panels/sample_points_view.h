// Two dimensions of the samples of a pixel, drawn as points over elementary intervals.
#pragma once
#include <imgui.h>

#include <span>
#include <string>

#include "base/vec.h"
#include "viewer/panels/interval_grid.h"
#include "viewer/state/app_state.h"

namespace etendue::viewer {

// Draws the points, with colours by half-buffer, into a square at the bottom of the frame, below a line with `title`.
void draw_sample_points(const UiContext& ui, ImDrawList* draw, const Placement& frame, const std::string& title,
                        std::span<const Vec2> points, IntervalShape intervals);

}  // namespace etendue::viewer
