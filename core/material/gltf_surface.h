// Builds the lobes of a material at a surface point: those of the glTF surface, or of its BSDF model.
#pragma once
#include "bsdf/all_lobes.h"
#include "bsdf/lobe_set.h"
#include "material/surface_material.h"

namespace etendue {

// The microfacets of the glTF surface: alpha = roughness^2, and KHR_materials_anisotropy raises alpha along the
// tangent, alpha_x = mix(alpha, 1, anisotropy^2). Values are clamped to [0, 1].
Ggx gltf_microfacets(float roughness, float anisotropy);

// Adds the lobes of the material to an empty set. Each overload serves the scenes that need no more than its set: the
// material must have is_lambertian, uses_standard_lobes, or neither.
template <class Color>
[[gnu::always_inline]] inline void add_lobes(const SurfaceMaterial& material, const TexturePoint& point,
                                             DiffuseOnly<Color>& lobes) {
  const Vec4 base =
      material.has_constant_base_color ? clamped(material.base_factor * point.color) : material.base_color_at(point);
  lobes.add(Lambert<Color>{Color(base.x, base.y, base.z)});
}

void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, StandardLobes<Rgb>& lobes);
// `coat_normal` is the normal of the clear coat in the shading frame.
void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, AllLobes<Rgb>& lobes,
               const Vec3& coat_normal = Vec3(0, 0, 1));

}  // namespace etendue
