// The lobes of glTF's surface at a point.
#pragma once
#include "bsdf/all_lobes.h"
#include "bsdf/lobe_set.h"
#include "material/surface_material.h"

namespace etendue {

// The two axes of GGX: alpha = roughness^2, stretched along the tangent as KHR_materials_anisotropy says.
Ggx facets_of(float roughness, float anisotropy);

// The lobes of glTF's material at a point (see layered.h, dielectric.h, thin_sheet.h for what they are).
template <class Color>
void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, DiffuseOnly<Color>& lobes) {
  const Vec4 base =
      material.has_constant_base_color ? clamped(material.base_factor * point.color) : material.base_at(point);
  lobes.add(Lambert<Color>{Color(base.x, base.y, base.z)});
}

void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, StandardLobes<Rgb>& lobes);
// `coat_normal` is that of the clear coat in the shading frame.
void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, AllLobes<Rgb>& lobes,
               const Vec3& coat_normal = Vec3(0, 0, 1));

}  // namespace etendue
