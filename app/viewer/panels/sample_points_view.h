// Two dimensions of the samples of a pixel, drawn as points over elementary intervals.
#pragma once
#include <imgui.h>

#include <array>
#include <span>
#include <string>

#include "base/parameter.h"
#include "base/vec.h"
#include "viewer/state/app_state.h"

namespace etendue::viewer {

// The elementary intervals of equal area that are drawn: as many as there are points of a half-buffer, or the next smaller
// power of two. A (0, m, 2)-net has the same number of points of each half-buffer in each of them.
enum class IntervalShape : uint8_t { square, columns, rows, none };

// The number of columns and rows of intervals for this number of points.
std::array<int, 2> interval_grid(IntervalShape shape, uint32_t points);

// Draws the points, with colours by half-buffer, into a square at the bottom of the frame, below a line with `title`.
void draw_sample_points(const UiContext& ui, ImDrawList* draw, const Placement& frame, const std::string& title,
                        std::span<const Vec2> points, IntervalShape intervals);

}  // namespace etendue::viewer

template <>
struct etendue::Options<etendue::viewer::IntervalShape> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"square", "Squares"}, {"columns", "Columns"}, {"rows", "Rows"}, {"none", "None"}}};
};
