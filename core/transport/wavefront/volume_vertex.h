// A vertex at a collision in a scattering medium, as a surface point that has no surface.
#pragma once
#include <span>

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

// Sets the points of vertices of which some lie in volumes. `collisions` and `wo` have an entry per vertex.
// surfaces(begin, end) sets the points of vertices on surfaces.
template <class Surfaces>
void set_points(std::span<const Collision> collisions, const Vec3* wo, scene::SurfacePoint* points,
                Surfaces&& surfaces) {
  size_t begin = 0;  // of a run of vertices on surfaces
  for (size_t i = 0; i < collisions.size(); ++i) {
    points[i].in_volume = false;
    if (!collisions[i].phase) continue;
    if (begin < i) surfaces(begin, i);
    set_volume_point(collisions[i], wo[i], points[i]);
    begin = i + 1;
  }
  if (begin < collisions.size()) surfaces(begin, collisions.size());
}

}  // namespace etendue::transport
