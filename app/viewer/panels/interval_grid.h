// Elementary intervals that are drawn below sample points.
#pragma once
#include <array>
#include <cstdint>

#include "base/parameter.h"

namespace etendue::viewer {

// The elementary intervals of equal area that are drawn: as many as there are points of a half-buffer, or the next smaller
// power of two. A (0, m, 2)-net has the same number of points of each half-buffer in each of them.
enum class IntervalShape : uint8_t { square, columns, rows, none };

// The number of columns and rows of intervals for this number of points.
std::array<int, 2> interval_grid(IntervalShape shape, uint32_t points);

}  // namespace etendue::viewer

template <>
struct etendue::Options<etendue::viewer::IntervalShape> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"square", "Squares"}, {"columns", "Columns"}, {"rows", "Rows"}, {"none", "None"}}};
};
