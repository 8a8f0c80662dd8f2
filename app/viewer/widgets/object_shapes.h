// Small symbols for kinds of objects: in the tree of the scene, and in the image.
#pragma once
#include <cstdint>

#include "base/vec.h"

struct ImDrawList;

namespace etendue::viewer {

// group: a node that has only children.
enum class ObjectKind : uint8_t { group, mesh, light, camera };

// A symbol that fits into a circle of radius r; `color` is an ImU32.
void draw_object_shape(ImDrawList& draw, ObjectKind kind, Vec2 at, float r, uint32_t color);

}  // namespace etendue::viewer
