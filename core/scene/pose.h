// What posing and importing have to agree on.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace etendue::scene {

// The matrix flattens space, or shrinks it beyond what single precision can undo: nothing placed by it has a surface.
bool is_singular(const Mat4& m);

// The animations that play together, in order: each that animates nothing which an earlier one does. Files hold either
// the parts of one movement (all play) or a choice of movements for the same nodes (the first plays).
std::vector<size_t> playing_animations(const Scene& scene);

}  // namespace etendue::scene
