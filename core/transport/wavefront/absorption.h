// What absorbing solids leave of light.                                                KHR_materials_volume; Beer's law
#pragma once
#include <cmath>

#include "scene/compiled_scene.h"

namespace etendue::transport {

// Over so many metres on the inner side of the surface that the point lies on.
template <class Color>
Color inner_transmittance(const scene::SurfacePoint& point, float distance) {
  const Material& m = point.material->description;
  if (!point.material->absorbs_inside) return Color(1);
  const float x = distance / m.attenuation_distance;
  return Color(std::pow(m.attenuation_color.r, x), std::pow(m.attenuation_color.g, x),
               std::pow(m.attenuation_color.b, x));
}

// The same along a segment that starts at the point.
template <class M>
typename M::Color transmittance(const scene::SurfacePoint& point, const Vec3& direction, float distance) {
  using Color = typename M::Color;
  if constexpr (!M::kAbsorbing)
    return Color(1);
  else
    return glm::dot(point.ng, direction) < 0 ? inner_transmittance<Color>(point, distance) : Color(1);
}

}  // namespace etendue::transport
