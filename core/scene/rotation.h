// Rotations and matrices as people edit them.
#pragma once
#include <optional>

#include "scene/scene.h"

namespace etendue::scene {

// Degrees of the turns about the parent's x, then y, then z that make the quaternion; y is between -90 and 90.
Vec3 euler_degrees(const Vec4& rotation);
// The unit quaternion of these turns.
Vec4 rotation_of(const Vec3& euler_degrees);

// The same transform without a matrix; nothing if its matrix shears or flattens and so has no such parts.
std::optional<Transform> decompose(const Transform& transform);

}  // namespace etendue::scene
