#include "material/surface_material.h"

#include "bsdf/all_lobe_types.h"
#include "material/gltf_surface.h"

namespace etendue {
namespace {

// The map of a use; empty if the texture does not exist or has no image.
SurfaceMaterial::Map resolve(const TextureUse& use, const std::vector<Texture>& textures) {
  SurfaceMaterial::Map map;
  if (use.texture < 0 || static_cast<size_t>(use.texture) >= textures.size()) return map;
  const Texture& texture = textures[static_cast<size_t>(use.texture)];
  if (!texture.tiles && (!texture.image || texture.image->empty())) return map;
  map.texture = &texture;
  map.use = use;
  map.identity = use.offset == Vec2(0) && use.scale == Vec2(1) && use.rotation == 0;
  map.scale = std::min(std::abs(use.scale.x), std::abs(use.scale.y));
  return map;
}

// The normal that a normal map encodes; `scale` multiplies its tangential part.
Vec3 mapped_normal(const SurfaceMaterial::Map& map, float scale, const TexturePoint& point) {
  if (!map) return Vec3(0, 0, 1);
  const Vec4 t = map.at(point, Encoding::linear);
  return normalize_or(Vec3((2 * t.x - 1) * scale, (2 * t.y - 1) * scale, 2 * t.z - 1), Vec3(0, 0, 1));
}

Rgb reflectance(const Vec4& c) {
  const Vec4 clamped = glm::clamp(c, 0.0f, 1.0f);
  return {clamped.x, clamped.y, clamped.z};
}

}  // namespace

SurfaceMaterial::SurfaceMaterial(const Material& m, const std::vector<Texture>& textures) : description(m) {
  description.emission = m.emission_spectrum.applied_to(m.emission);
  resolve_textures(textures);
  has_normal_map = normal || (clearcoat_normal && m.clearcoat > 0);
  has_coat_normal = has_normal_map && m.clearcoat > 0;
  has_constant_base_color = !base_color && !m.unlit;
  base_factor = Vec4(m.base_color.r, m.base_color.g, m.base_color.b, m.alpha);
  is_emissive = m.is_emissive() || m.unlit;
  has_alpha = m.alpha_mode != AlphaMode::opaque;
  absorbs_inside = m.is_solid() && ((std::isfinite(m.attenuation_distance) && !(m.attenuation_color == Rgb(1))) ||
                                    !m.medium.is_clear());
  if (m.model && !m.unlit) subsurface = m.model->subsurface();
  has_subsurface = !is_black(subsurface.mean_free_path);
  if (m.is_solid() && !m.unlit) inside = m.inside_index();
  if (m.model && !m.unlit)
    classify_model();
  else
    classify_gltf_surface();
  needs_tangent_frame = has_normal_map || is_anisotropic;
  if (is_lambertian) base_spectrum = RgbSpectrum::reflectance(Rgb(base_factor.x, base_factor.y, base_factor.z));
}

void SurfaceMaterial::resolve_textures(const std::vector<Texture>& textures) {
  const Material& m = description;
  for (const auto& [map, use] : std::initializer_list<std::pair<Map&, const TextureUse&>>{
           {base_color, m.base_color_texture},
           {metallic_roughness, m.metallic_roughness_texture},
           {normal, m.normal_texture},
           {emission, m.emission_texture},
           {specular, m.specular_texture},
           {specular_color, m.specular_color_texture},
           {transmission, m.transmission_texture},
           {anisotropy, m.anisotropy_texture},
           {clearcoat, m.clearcoat_texture},
           {clearcoat_roughness, m.clearcoat_roughness_texture},
           {clearcoat_normal, m.clearcoat_normal_texture},
           {sheen_color, m.sheen_color_texture},
           {sheen_roughness, m.sheen_roughness_texture},
           {iridescence, m.iridescence_texture},
           {iridescence_thickness, m.iridescence_thickness_texture},
           {diffuse_transmission, m.diffuse_transmission_texture},
           {diffuse_transmission_color, m.diffuse_transmission_color_texture}}) {
    map = resolve(use, textures);
    has_textures = has_textures || map;
    has_tiled_textures = has_tiled_textures || (map && map.texture->tiles);
  }
}

// The types of the lobes do not depend on the base colour, so one set of lobes represents all points.
void SurfaceMaterial::classify_model() {
  if (auto prepared = description.model->prepared()) description.model.model = std::move(prepared);
  AllLobes<Rgb> lobes;
  description.model->add_lobes(reflectance(base_factor), lobes);
  if (const auto* lambert = lobe_set(lobes).single_lobe_as<Lambert<Rgb>>()) {
    is_lambertian = true;
    is_opaque = true;
    uses_standard_lobes = true;
    const Rgb model_albedo = ratio(lambert->albedo, reflectance(base_factor));
    base_factor *= Vec4(model_albedo.r, model_albedo.g, model_albedo.b, 1);
  }
  DeltaSet<Rgb> deltas;
  lobes.add_deltas(Vec3(0, 0, 1), TransportMode::radiance, deltas);
  has_delta_lobes = deltas.count > 0;
  is_anisotropic = depends_on_azimuth(lobes);
  if (has_constant_base_color) constant_lobes = std::make_shared<AllLobes<Rgb>>(lobes);
}

void SurfaceMaterial::classify_gltf_surface() {
  const Material& m = description;
  const bool tinted_glass = m.transmission > 0 && m.thickness > 0 && (m.specular != 1 || !(m.specular_color == Rgb(1)));
  uses_standard_lobes = m.unlit || !(m.clearcoat > 0 || !is_black(m.sheen_color) || m.iridescence > 0 ||
                                     m.diffuse_transmission > 0 || m.specular_glossiness || tinted_glass);
  is_lambertian =
      m.unlit || (uses_standard_lobes && m.metallic == 0 && m.transmission == 0 && (m.specular == 0 || m.ior == 1.0f));
  is_opaque = m.unlit || (m.transmission == 0 && m.diffuse_transmission == 0);
  has_delta_lobes =
      !is_lambertian && (gltf_microfacets(m.roughness, m.anisotropy).alpha_x < kSmoothAlpha ||
                         (m.clearcoat > 0 && gltf_microfacets(m.clearcoat_roughness, 0).alpha_x < kSmoothAlpha));
  is_anisotropic = !is_lambertian && m.anisotropy > 0;
}

Vec4 SurfaceMaterial::base_color_at(const TexturePoint& point) const {
  if (description.unlit) return Vec4(0, 0, 0, 1);
  Vec4 base = base_factor * point.color;
  if (base_color) base *= base_color.at(point, Encoding::srgb);
  return clamped(base);
}

float SurfaceMaterial::opacity_at(const TexturePoint& point) const {
  const Material& m = description;
  if (m.alpha_mode == AlphaMode::opaque) return 1;
  float alpha = m.alpha * point.color.w;
  if (base_color) alpha *= base_color.at(point, Encoding::srgb).w;
  if (m.alpha_mode == AlphaMode::mask) return alpha >= m.alpha_cutoff ? 1.0f : 0.0f;
  return std::clamp(alpha, 0.0f, 1.0f);
}

Rgb SurfaceMaterial::emission_at(const TexturePoint& point) const {
  const Material& m = description;
  if (m.unlit) {
    Vec4 color = Vec4(m.base_color.r, m.base_color.g, m.base_color.b, 1) * point.color;
    if (base_color) color *= base_color.at(point, Encoding::srgb);
    return {color.x, color.y, color.z};
  }
  if (!emission) return m.emission;
  const Vec4 e = emission.at(point, Encoding::srgb);
  return m.emission * Rgb(e.x, e.y, e.z);
}

Vec3 SurfaceMaterial::normal_at(const TexturePoint& point) const {
  return mapped_normal(normal, description.normal_scale, point);
}

Vec3 SurfaceMaterial::coat_normal_at(const TexturePoint& point) const {
  return mapped_normal(clearcoat_normal, description.clearcoat_normal_scale, point);
}

}  // namespace etendue
