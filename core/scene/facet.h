// Triangles of instances in world space.
#pragma once
#include "scene/compiled_scene.h"

namespace etendue::scene {

// A bound of the rounding error of a point on a triangle. Intersection uses coordinates relative to the vertices, so
// the error grows with the distance of the triangle from the origin and with its size.
[[gnu::always_inline]] inline float offset_bound(const Vec3& position, const Vec3& e1, const Vec3& e2) {
  const float far = max_component(glm::abs(position));
  const float size = max_component(glm::abs(e1)) + max_component(glm::abs(e2));
  return 16 * 0x1p-24f * (far + 2 * size);
}

// A triangle of a mesh at a time from 0 at shutter opening to 1 at shutter closing.
inline Facet facet_of(const InstanceData& instance, uint32_t triangle, float time) {
  const Triangle& t = instance.mesh->triangles[triangle];
  if (instance.motion) return instance.motion->facet_at(*instance.mesh, t, time);
  const auto corner = [&](size_t k) {
    const Vec3& p = instance.mesh->positions[t[k]];
    return instance.identity ? p : Vec3(instance.to_world * Vec4(p, 1));
  };
  return {corner(0), corner(1), corner(2), instance.mirrored ? -1.0f : 1.0f};
}

// The unit normal on the front side.
inline Vec3 normal_of(const Facet& facet) {
  return glm::normalize(glm::cross(facet.p1 - facet.p0, facet.p2 - facet.p0)) * facet.winding;
}

}  // namespace etendue::scene
