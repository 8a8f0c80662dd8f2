// A vertex at a collision in a scattering medium, as a surface point that has no surface.
#pragma once
#include "medium/phase_function.h"
#include "scene/compiled_scene.h"

namespace etendue::transport {

// The end of a segment in a medium.
struct Collision {
  Vec3 position{0};
  const PhaseFunction* phase = nullptr;  // null: the segment ends on a surface
  Rgb scattering{0};                     // the scattering coefficient, 1/m
};

// Sets the point of a collision. It does not emit light, belongs to no light, and rays that leave it are not offset.
void set_volume_point(const Collision& collision, const Vec3& wo, scene::SurfacePoint& point);

}  // namespace etendue::transport
