// The lobes of glTF's surface at a point: core, and the Khronos extensions.
//
//   coat over sheen over mix(dielectric, metal),   dielectric = layer over mix(mix(diffuse, diffuse through), through)
#include "material/gltf_surface.h"

#include "bsdf/all_lobe_types.h"

namespace etendue {
namespace {

float unit(float x) { return std::clamp(x, 0.0f, 1.0f); }
Rgb unit(const Rgb& c) { return {unit(c.r), unit(c.g), unit(c.b)}; }
Rgb rgb_of(const Vec4& c) { return {c.x, c.y, c.z}; }

// The factor times a channel of the map, if there is one.
float scaled(float factor, const SurfaceMaterial::Map& map, const TexturePoint& point, int channel) {
  return map ? factor * map.at(point, Encoding::linear)[channel] : factor;
}
Rgb scaled(const Rgb& factor, const SurfaceMaterial::Map& map, const TexturePoint& point) {
  return map ? factor * rgb_of(map.at(point, Encoding::srgb)) : factor;
}

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

// What the textures make of the factors.
struct Numbers {
  Rgb base{0};
  float metallic = 0, roughness = 1, specular = 1, transmission = 0;
  Rgb f0{0};  // of the dielectric, with its strength
  Ggx facets;

  float through() const { return (1 - metallic) * transmission; }
  float solid() const { return (1 - metallic) * (1 - transmission); }
};

[[gnu::always_inline]] inline Numbers look(const SurfaceMaterial& material, const TexturePoint& point) {
  const Material& m = material.description;
  Numbers n;
  n.base = unit(rgb_of(material.base_at(point)));
  float metallic = m.metallic;
  n.roughness = m.roughness;
  if (material.metallic_roughness) {
    const Vec4 t = material.metallic_roughness.at(point, Encoding::linear);
    n.roughness *= t.y, metallic *= t.z;
  }
  n.metallic = unit(metallic);
  n.specular = scaled(m.specular, material.specular, point, 3);
  n.transmission = unit(scaled(m.transmission, material.transmission, point, 0));
  const Rgb specular_color = scaled(m.specular_color, material.specular_color, point);
  n.f0 = unit(specular_color * (m.ior == 0 ? 1.0f : f0_from_ior(m.ior))) * n.specular;
  n.facets = facets_at(material, point, n.roughness);
  return n;
}

// KHR_materials_pbrSpecularGlossiness: alpha of the specular texture is glossiness, and what the layer reflects at
// normal incidence is missing from the diffuse colour, before the Fresnel term takes its share.
Numbers look_at_glossiness(const SurfaceMaterial& material, const TexturePoint& point) {
  const Material& m = material.description;
  Numbers n;
  n.f0 = unit(scaled(m.specular_color, material.specular_color, point));
  n.base = unit(rgb_of(material.base_at(point))) * (1 - max_component(n.f0));
  n.roughness = 1 - scaled(1 - m.roughness, material.metallic_roughness, point, 3);
  n.facets = facets_of(n.roughness, 0);
  return n;
}

// What follows is written in place: copies of lobes are what putting them together costs.

void set_opaque(const Numbers& n, SchlickFresnel<Rgb>& fresnel) {
  fresnel.f0 = n.f0 * n.solid() + n.base * n.metallic;
  fresnel.f90 = Rgb(n.specular * n.solid() + n.metallic);
  fresnel.dielectric_f0 = max_component(n.f0), fresnel.dielectric_f90 = n.specular;
}

void set_sheet(const Numbers& n, SchlickFresnel<Rgb>& fresnel) {
  fresnel.f0 = n.f0, fresnel.f90 = Rgb(n.specular);
  fresnel.dielectric_f0 = max_component(n.f0), fresnel.dielectric_f90 = n.specular;
}

template <class Lobe>
void set_glass(const Material& m, const Numbers& n, Lobe& glass) {
  glass.tint = n.base, glass.eta = m.ior == 0 ? 1e4f : m.ior;
  glass.share = n.through(), glass.facets = n.facets;
}

template <class Lobe>
void set_sheet_lobe(const Numbers& n, Lobe& sheet) {
  sheet.tint = n.base, sheet.share = n.through(), sheet.facets = n.facets;
}

template <class Lobes>
void add_opaque(const Numbers& n, float diffuse, Lobes& lobes) {
  MetallicRoughness<Rgb> layered;
  set_opaque(n, layered);
  layered.base = n.base * diffuse, layered.facets = n.facets;
  lobes.add(layered);
}

template <class Lobes>
[[gnu::always_inline]] inline void add_core(const Material& m, const Numbers& n, Lobes& lobes) {
  const float through = n.through();
  if (through < 1) add_opaque(n, n.solid(), lobes);
  if (through > 0 && m.thickness > 0) {
    Dielectric<Rgb> glass;
    set_glass(m, n, glass);
    lobes.add(glass);
  } else if (through > 0) {
    ThinTransmission<Rgb> sheet;
    set_sheet(n, sheet), set_sheet_lobe(n, sheet);
    lobes.add(sheet);
  }
}

FilmFresnel<Rgb> film_fresnel(const SurfaceMaterial& material, const TexturePoint& point, const Numbers& n) {
  const Material& m = material.description;
  FilmFresnel<Rgb> fresnel;
  fresnel.dielectric_f0 = n.f0, fresnel.dielectric_f90 = n.specular;
  fresnel.metal_f0 = n.base;
  fresnel.dielectric = n.solid(), fresnel.metal = n.metallic;
  fresnel.strength = unit(scaled(m.iridescence, material.iridescence, point, 0));
  fresnel.film.ior = m.iridescence_ior;
  const float blend = scaled(1, material.iridescence_thickness, point, 1);
  fresnel.film.thickness =
      m.iridescence_thickness_min + (m.iridescence_thickness_max - m.iridescence_thickness_min) * blend;
  return fresnel;
}

void set_boundary(const Material& m, const Numbers& n, const FilmFresnel<Rgb>& fresnel, TintedBoundary<Rgb>& boundary) {
  boundary.clear_f0 = f0_from_ior(m.ior == 0 ? 1e4f : m.ior);
  boundary.f0 = n.f0, boundary.f90 = n.specular;
  boundary.film = fresnel.film, boundary.strength = fresnel.strength;
}

void add_filmed(const Numbers& n, const FilmFresnel<Rgb>& fresnel, float diffuse, AnyLobeSet<Rgb>& lobes) {
  MetallicRoughness<Rgb, FilmFresnel<Rgb>> layered;
  static_cast<FilmFresnel<Rgb>&>(layered) = fresnel;
  layered.base = n.base * diffuse, layered.facets = n.facets;
  lobes.add(layered);
}

// What lies below sheen and coat.
void add_base(const SurfaceMaterial& material, const TexturePoint& point, const Numbers& n, AnyLobeSet<Rgb>& lobes) {
  const Material& m = material.description;
  const float scattered = unit(scaled(m.diffuse_transmission, material.diffuse_transmission, point, 3));
  const FilmFresnel<Rgb> fresnel = film_fresnel(material, point, n);
  const float through = n.through();
  if (through < 1) {
    const float diffuse = n.solid() * (1 - scattered);
    if (fresnel.strength > 0)
      add_filmed(n, fresnel, diffuse, lobes);
    else
      add_opaque(n, diffuse, lobes);
  }
  if (n.solid() * scattered > 0) {
    DiffuseTransmission<Rgb, FilmFresnel<Rgb>> behind;
    behind.color = unit(scaled(m.diffuse_transmission_color, material.diffuse_transmission_color, point)) *
                   (n.solid() * scattered);
    behind.layer = fresnel;
    lobes.add(behind);
  }
  if (through > 0 && m.thickness > 0) {
    Dielectric<Rgb, TintedBoundary<Rgb>> glass;
    set_boundary(m, n, fresnel, glass), set_glass(m, n, glass);
    lobes.add(glass);
  } else if (through > 0) {
    ThinTransmission<Rgb, FilmFresnel<Rgb>> sheet;
    static_cast<FilmFresnel<Rgb>&>(sheet) = fresnel;
    sheet.dielectric = 1, sheet.metal = 0;
    set_sheet_lobe(n, sheet);
    lobes.add(sheet);
  }
}

void add_sheen(const SurfaceMaterial& material, const TexturePoint& point, AnyLobeSet<Rgb>& lobes) {
  const Material& m = material.description;
  Sheen<Rgb> sheen;
  sheen.color = unit(scaled(m.sheen_color, material.sheen_color, point));
  sheen.roughness = unit(scaled(m.sheen_roughness, material.sheen_roughness, point, 3));
  if (is_black(sheen.color)) return;
  lobes.cover(SheenCoating{max_component(sheen.color), sheen.roughness});
  lobes.add(sheen);
}

void add_coat(const SurfaceMaterial& material, const TexturePoint& point, const Vec3& normal, AnyLobeSet<Rgb>& lobes) {
  const Material& m = material.description;
  Clearcoat<Rgb> coat;
  coat.strength = unit(scaled(m.clearcoat, material.clearcoat, point, 0));
  if (coat.strength == 0) return;
  coat.frame = Frame(normal);
  coat.facets = facets_of(scaled(m.clearcoat_roughness, material.clearcoat_roughness, point, 1), 0);
  lobes.cover(DielectricCoating{normal, coat.strength, kCoatF0, 1});
  lobes.add(coat);
}

}  // namespace

Ggx facets_of(float roughness, float anisotropy) {
  const float alpha = sqr(unit(roughness));
  Ggx facets;
  facets.alpha_x = alpha + (1 - alpha) * sqr(unit(anisotropy));
  facets.alpha_y = alpha;
  // A groove without any width across it has no density that floats could hold.
  if (facets.alpha_x >= kSmoothAlpha) facets.alpha_y = std::max(facets.alpha_y, kSmoothAlpha);
  return facets;
}

void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, StandardLobes<Rgb>& lobes) {
  if (material.is_lambertian) return lobes.add(Lambert<Rgb>{unit(rgb_of(material.base_at(point)))});
  add_core(material.description, look(material, point), lobes);
}

void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, AllLobes<Rgb>& all,
               const Vec3& coat_normal) {
  const Material& m = material.description;
  AnyLobeSet<Rgb>& lobes = lobe_set(all);
  if (material.constant_lobes && point.color == Vec4(1)) {
    all = *material.constant_lobes;
  } else if (material.is_lambertian) {
    lobes.add(Lambert<Rgb>{unit(rgb_of(material.base_at(point)))});
  } else if (m.model) {
    m.model->add_lobes(unit(rgb_of(material.base_at(point))), all);
  } else if (material.uses_standard_lobes) {
    add_core(m, look(material, point), lobes);
  } else if (m.specular_glossiness) {
    add_core(m, look_at_glossiness(material, point), lobes);
  } else {
    add_base(material, point, look(material, point), lobes);
    if (!is_black(m.sheen_color)) add_sheen(material, point, lobes);
    if (m.clearcoat > 0) add_coat(material, point, coat_normal, lobes);
  }
}

}  // namespace etendue
