// Conversions between the rotations that users edit and those that a Transform stores.
#pragma once
#include <optional>

#include "scene/scene.h"

namespace etendue::scene {

// Euler angles in degrees: rotations about the x, then y, then z axis of the parent. y is in [-90, 90].
Vec3 euler_degrees(const Vec4& rotation);
// The unit quaternion with these Euler angles.
Vec4 rotation_of(const Vec3& euler_degrees);

// The same transform as translation, rotation and scale; nothing if its matrix has shear or is singular.
std::optional<Transform> decompose(const Transform& transform);

}  // namespace etendue::scene
