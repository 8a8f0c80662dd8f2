#include "material/surface.h"

namespace etendue {
namespace {

SurfaceMaterial::Map resolved(const TextureUse& use, const std::vector<Texture>& textures) {
  SurfaceMaterial::Map map;
  if (use.texture < 0 || static_cast<size_t>(use.texture) >= textures.size()) return map;
  const Texture& texture = textures[static_cast<size_t>(use.texture)];
  if (!texture.image || texture.image->empty()) return map;
  map.texture = &texture;
  map.use = use;
  map.identity = use.offset == Vec2(0) && use.scale == Vec2(1) && use.rotation == 0;
  return map;
}

float unit(float x) { return std::clamp(x, 0.0f, 1.0f); }

Rgb reflectance(const Vec4& c) { return {unit(c.x), unit(c.y), unit(c.z)}; }

// The facets at a point: the texture turns and weakens what the factors say.
Ggx facets_at(const SurfaceMaterial& material, const TexturePoint& point, float roughness) {
  const Material& m = material.description;
  if (m.anisotropy == 0) return facets_of(roughness, 0);
  const Vec2 turn(std::cos(m.anisotropy_rotation), std::sin(m.anisotropy_rotation));
  Vec2 direction(1, 0);
  float strength = m.anisotropy;
  if (material.anisotropy) {
    const Vec4 t = material.anisotropy.at(point, Encoding::linear);
    const Vec2 d(2 * t.x - 1, 2 * t.y - 1);
    if (const float length = glm::length(d); length > 1e-3f) direction = d / length;
    strength *= t.z;
  }
  Ggx facets = facets_of(roughness, strength);
  facets.along = Vec2(turn.x * direction.x - turn.y * direction.y, turn.y * direction.x + turn.x * direction.y);
  return facets;
}

}  // namespace

SurfaceMaterial::SurfaceMaterial(const Material& m, const std::vector<Texture>& textures) : description(m) {
  base_color = resolved(m.base_color_texture, textures);
  metallic_roughness = resolved(m.metallic_roughness_texture, textures);
  normal = resolved(m.normal_texture, textures);
  emission = resolved(m.emission_texture, textures);
  specular = resolved(m.specular_texture, textures);
  specular_color = resolved(m.specular_color_texture, textures);
  transmission = resolved(m.transmission_texture, textures);
  anisotropy = resolved(m.anisotropy_texture, textures);
  plain = !base_color && !m.unlit;
  factor = Vec4(m.base_color.r, m.base_color.g, m.base_color.b, m.alpha);
  shines = m.emits() || m.unlit;
  transparent = m.alpha_mode != AlphaMode::opaque;
  textured = base_color || metallic_roughness || normal || emission || specular || specular_color || transmission ||
             anisotropy;
  absorbs = m.solid() && std::isfinite(m.attenuation_distance) && !(m.attenuation_color == Rgb(1));
  if (m.reflection && !m.unlit)
    prepare_model();
  else
    look_at_gltf();
}

// What the lobes of the model are, as its base colour makes no others of them.
void SurfaceMaterial::prepare_model() {
  WideLobes<Rgb> lobes;
  description.reflection->add_lobes(reflectance(factor), lobes);
  if (const auto* lambert = lobes.only<Lambert<Rgb>>()) {
    diffuse = standard = true;
    // Base colour and model are one factor.
    const Rgb share = ratio(lambert->albedo, reflectance(factor));
    factor *= Vec4(share.r, share.g, share.b, 1);
  }
  Deltas<Rgb> deltas;
  lobes.add_deltas(Vec3(0, 0, 1), Transport::radiance, deltas);
  specular_deltas = deltas.count > 0;
  if (plain) ready = std::make_shared<WideLobes<Rgb>>(lobes);
}

void SurfaceMaterial::look_at_gltf() {
  const Material& m = description;
  diffuse = m.unlit || (m.metallic == 0 && m.transmission == 0 &&
                        (m.specular == 0 || (is_black(m.specular_color) && m.specular == 0) || m.ior == 1.0f));
  standard = true;
  specular_deltas = !diffuse && facets_of(m.roughness, m.anisotropy).alpha_x < kSmoothAlpha;
}

Vec4 SurfaceMaterial::base_at(const TexturePoint& point) const {
  if (description.unlit) return Vec4(0, 0, 0, 1);
  Vec4 base = factor * point.color;
  if (base_color) base *= base_color.at(point, Encoding::srgb);
  return clamped(base);
}

float SurfaceMaterial::opacity_at(const TexturePoint& point) const {
  const Material& m = description;
  if (m.alpha_mode == AlphaMode::opaque) return 1;
  float alpha = m.alpha * point.color.w;
  if (base_color) alpha *= base_color.at(point, Encoding::srgb).w;
  if (m.alpha_mode == AlphaMode::mask) return alpha >= m.alpha_cutoff ? 1.0f : 0.0f;
  return unit(alpha);
}

Rgb SurfaceMaterial::emission_at(const TexturePoint& point) const {
  const Material& m = description;
  if (m.unlit) {
    Vec4 shown = Vec4(m.base_color.r, m.base_color.g, m.base_color.b, 1) * point.color;
    if (base_color) shown *= base_color.at(point, Encoding::srgb);
    return {shown.x, shown.y, shown.z};
  }
  if (!emission) return m.emission;
  const Vec4 e = emission.at(point, Encoding::srgb);
  return m.emission * Rgb(e.x, e.y, e.z);
}

Vec3 SurfaceMaterial::normal_at(const TexturePoint& point) const {
  if (!normal) return Vec3(0, 0, 1);
  const Vec4 t = normal.at(point, Encoding::linear);
  const float s = description.normal_scale;
  return normalize_or(Vec3((2 * t.x - 1) * s, (2 * t.y - 1) * s, 2 * t.z - 1), Vec3(0, 0, 1));
}

Ggx facets_of(float roughness, float anisotropy) {
  const float alpha = sqr(unit(roughness));
  Ggx facets;
  facets.alpha_x = alpha + (1 - alpha) * sqr(unit(anisotropy));
  facets.alpha_y = alpha;
  // A groove without any width across it has no density that floats could hold.
  if (facets.alpha_x >= kSmoothAlpha) facets.alpha_y = std::max(facets.alpha_y, kSmoothAlpha);
  return facets;
}

namespace {

template <class Lobes>
void add_gltf_lobes(const SurfaceMaterial& material, const TexturePoint& point, Lobes& lobes) {
  const Material& m = material.description;
  const Rgb base = reflectance(material.base_at(point));
  if (material.diffuse) return lobes.add(Lambert<Rgb>{base});

  float metallic = m.metallic, roughness = m.roughness;
  if (material.metallic_roughness) {
    const Vec4 t = material.metallic_roughness.at(point, Encoding::linear);
    roughness *= t.y, metallic *= t.z;
  }
  metallic = unit(metallic);
  float specular = m.specular;
  if (material.specular) specular *= material.specular.at(point, Encoding::linear).w;
  Rgb specular_color = m.specular_color;
  if (material.specular_color) {
    const Vec4 t = material.specular_color.at(point, Encoding::srgb);
    specular_color *= Rgb(t.x, t.y, t.z);
  }
  float transmission = m.transmission;
  if (material.transmission) transmission *= material.transmission.at(point, Encoding::linear).x;
  const float through = (1 - metallic) * unit(transmission);
  const float solid_base = (1 - metallic) * (1 - unit(transmission));

  const Rgb bright = specular_color * (m.ior == 0 ? 1.0f : f0_from_ior(m.ior));
  const Rgb dielectric_f0 = Rgb(unit(bright.r), unit(bright.g), unit(bright.b)) * specular;
  const Ggx facets = facets_at(material, point, roughness);

  if (through < 1) {
    Layered<Rgb> layered;
    layered.base = base * solid_base;
    layered.f0 = dielectric_f0 * solid_base + base * metallic;
    layered.f90 = Rgb(specular * solid_base + metallic);
    layered.dielectric_f0 = max_component(dielectric_f0);
    layered.dielectric_f90 = specular;
    layered.facets = facets;
    lobes.add(layered);
  }
  if (through > 0 && m.thickness > 0) {
    Dielectric<Rgb> glass;
    glass.tint = base;
    glass.reflect_tint =
        Rgb(unit(specular * specular_color.r), unit(specular * specular_color.g), unit(specular * specular_color.b));
    glass.eta = m.ior == 0 ? 1e4f : m.ior;
    glass.share = through;
    glass.facets = facets;
    lobes.add(glass);
  } else if (through > 0) {
    ThinSheet<Rgb> sheet;
    sheet.tint = base;
    sheet.f0 = dielectric_f0;
    sheet.f90 = Rgb(specular);
    sheet.share = through;
    sheet.facets = facets;
    lobes.add(sheet);
  }
}

}  // namespace

void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, LobeMix<Rgb>& lobes) {
  add_gltf_lobes(material, point, lobes);
}

void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, WideLobes<Rgb>& lobes) {
  if (material.ready && point.color == Vec4(1)) {
    lobes = *material.ready;
  } else if (material.description.reflection && !material.diffuse) {
    material.description.reflection->add_lobes(reflectance(material.base_at(point)), lobes);
  } else {
    add_gltf_lobes(material, point, lobes);
  }
}

}  // namespace etendue
