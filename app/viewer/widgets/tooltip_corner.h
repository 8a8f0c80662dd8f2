// Where a tooltip is placed.
#pragma once
#include <optional>

#include "viewer/viewport/placement.h"

namespace etendue::viewer {

// The upper left corner of a tooltip of this size, which does not cover the item that it explains: below the item,
// otherwise above it, otherwise beside it; beside an upright item first, whose ends may be far from the pointer. Nothing
// if there is no room in a window of size `screen`. `gap` is the distance from the item.
std::optional<Vec2> tooltip_corner(const Placement& item, Vec2 size, Vec2 screen, Vec2 pointer, float gap);

}  // namespace etendue::viewer
