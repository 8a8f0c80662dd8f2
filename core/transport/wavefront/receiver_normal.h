// The normal of a vertex by which the light tree bounds the cosine of incident light.
#pragma once
#include "light/sampling/light_receiver.h"
#include "scene/compiled_scene.h"

namespace etendue::transport {

// The shading normal on the side of `wo`. None in a medium and on surfaces that may transmit light, which receive light
// from all directions.
inline PackedNormal receiver_normal(const scene::SurfacePoint& point, const Vec3& wo) {
  if (point.in_volume || !point.material->is_opaque) return {};
  return PackedNormal(glm::dot(point.ng, wo) < 0 ? -point.shading.z : point.shading.z);
}

}  // namespace etendue::transport
