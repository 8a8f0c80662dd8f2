// Where a camera sees a segment, for drawings over its image.
#pragma once
#include <array>
#include <optional>

#include "camera/camera.h"

namespace etendue {

// The ends of the part of a segment that lies in front of the camera, in pixels of an image of this size; they may lie
// outside of it. The lens is taken as a pinhole, and clipping planes are ignored. Nothing if the segment lies behind the
// camera.
std::optional<std::array<Vec2, 2>> project_segment(const Camera& camera, Vec2i image_size, const Vec3& from,
                                                   const Vec3& to);

}  // namespace etendue
