// The structure of the glTF surface, core and extensions:
//
//   surface    = coat over sheen over mix(dielectric, metal, metallic)
//   dielectric = specular layer over mix(mix(diffuse, diffuse transmission), transmission)
//
// The mixture of dielectric and metal is one MetallicRoughness lobe; transmissions are lobes of their own. These
// functions run at every hit. Lobes are filled in place, because copying them dominates the cost.
#include "material/gltf_surface.h"

#include "bsdf/all_lobe_types.h"

namespace etendue {
namespace {

// The index of refraction that stands for ior = 0, a Fresnel term of 1.
constexpr float kPerfectMirrorIor = 1e4f;

float unit(float x) { return std::clamp(x, 0.0f, 1.0f); }
Rgb unit(const Rgb& c) { return {unit(c.r), unit(c.g), unit(c.b)}; }
Rgb rgb_of(const Vec4& c) { return {c.x, c.y, c.z}; }

// The factor times a channel of the texture, if there is one.
float textured(float factor, const SurfaceMaterial::Map& map, const TexturePoint& point, int channel) {
  return map ? factor * map.at(point, Encoding::linear)[channel] : factor;
}
Rgb textured(const Rgb& factor, const SurfaceMaterial::Map& map, const TexturePoint& point) {
  return map ? factor * rgb_of(map.at(point, Encoding::srgb)) : factor;
}

// The microfacets at a point. The anisotropy texture rotates the direction and scales the strength.
Ggx microfacets_at(const SurfaceMaterial& material, const TexturePoint& point, float roughness) {
  const Material& m = material.description;
  if (m.anisotropy == 0) return gltf_microfacets(roughness, 0);
  const Vec2 rotation(std::cos(m.anisotropy_rotation), std::sin(m.anisotropy_rotation));
  Vec2 direction(1, 0);
  float strength = m.anisotropy;
  if (material.anisotropy) {
    const Vec4 t = material.anisotropy.at(point, Encoding::linear);
    const Vec2 d(2 * t.x - 1, 2 * t.y - 1);
    if (const float length = glm::length(d); length > 1e-3f) direction = d / length;
    strength *= t.z;
  }
  Ggx facets = gltf_microfacets(roughness, strength);
  facets.along =
      Vec2(rotation.x * direction.x - rotation.y * direction.y, rotation.y * direction.x + rotation.x * direction.y);
  return facets;
}

// The parameters of the core material at a point, textures included.
struct CoreParameters {
  Rgb base{0};
  float metallic = 0, roughness = 1, specular = 1, transmission = 0;
  Rgb specular_color{1};
  Rgb f0{0};  // reflectance of the dielectric at normal incidence, including `specular`
  Ggx facets;
  bool conserves_energy = false;  // Material::layering

  // The parts of the mixture that are a transmitting and an opaque dielectric; the rest is metal.
  float transmitting_part() const { return (1 - metallic) * transmission; }
  float opaque_dielectric_part() const { return (1 - metallic) * (1 - transmission); }
};

[[gnu::always_inline]] inline CoreParameters metallic_roughness_at(const SurfaceMaterial& material,
                                                                   const TexturePoint& point) {
  const Material& m = material.description;
  CoreParameters p;
  p.conserves_energy = m.layering == Layering::energy_conserving;
  p.base = unit(rgb_of(material.base_color_at(point)));
  float metallic = m.metallic;
  p.roughness = m.roughness;
  if (material.metallic_roughness) {
    const Vec4 t = material.metallic_roughness.at(point, Encoding::linear);
    p.roughness *= t.y;
    metallic *= t.z;
  }
  p.metallic = unit(metallic);
  p.specular = textured(m.specular, material.specular, point, 3);
  p.transmission = unit(textured(m.transmission, material.transmission, point, 0));
  p.specular_color = textured(m.specular_color, material.specular_color, point);
  p.f0 = unit(p.specular_color * (m.ior == 0 ? 1.0f : f0_from_ior(m.ior))) * p.specular;
  p.facets = microfacets_at(material, point, p.roughness);
  return p;
}

// KHR_materials_pbrSpecularGlossiness: the alpha channel of the specular texture is glossiness. The diffuse colour is
// reduced by the reflectance at normal incidence, in addition to the attenuation by the Fresnel term.
CoreParameters specular_glossiness_at(const SurfaceMaterial& material, const TexturePoint& point) {
  const Material& m = material.description;
  CoreParameters p;
  p.conserves_energy = m.layering == Layering::energy_conserving;
  p.f0 = unit(textured(m.specular_color, material.specular_color, point));
  p.base = unit(rgb_of(material.base_color_at(point))) * (1 - max_component(p.f0));
  p.roughness = 1 - textured(1 - m.roughness, material.metallic_roughness, point, 3);
  p.facets = gltf_microfacets(p.roughness, 0);
  return p;
}

void set_mixed_fresnel(const CoreParameters& p, SchlickFresnel<Rgb>& fresnel) {
  fresnel.f0 = p.f0 * p.opaque_dielectric_part() + p.base * p.metallic;
  fresnel.f90 = Rgb(p.specular * p.opaque_dielectric_part() + p.metallic);
  fresnel.dielectric_f0 = max_component(p.f0);
  fresnel.dielectric_f90 = p.specular;
}

void set_dielectric_fresnel(const CoreParameters& p, SchlickFresnel<Rgb>& fresnel) {
  fresnel.f0 = p.f0;
  fresnel.f90 = Rgb(p.specular);
  fresnel.dielectric_f0 = max_component(p.f0);
  fresnel.dielectric_f90 = p.specular;
}

template <class Lobe>
void set_dielectric(const Material& m, const CoreParameters& p, Lobe& lobe) {
  lobe.tint = p.base;
  lobe.eta = m.ior == 0 ? kPerfectMirrorIor : m.ior;
  lobe.share = p.transmitting_part();
  lobe.facets = p.facets;
}

template <class Lobe>
void set_thin_transmission(const CoreParameters& p, Lobe& lobe) {
  lobe.tint = p.base;
  lobe.share = p.transmitting_part();
  lobe.facets = p.facets;
}

template <class Lobes>
void add_metallic_roughness(const CoreParameters& p, float diffuse_part, Lobes& lobes) {
  MetallicRoughness<Rgb> lobe;
  set_mixed_fresnel(p, lobe);
  lobe.base = p.base * diffuse_part;
  lobe.facets = p.facets;
  if (p.conserves_energy) lobe.conserve_energy();
  lobes.add(lobe);
}

// The lobes of the core material and of the extensions that StandardLobes covers.
template <class Lobes>
[[gnu::always_inline]] inline void add_core_lobes(const Material& m, const CoreParameters& p, Lobes& lobes) {
  const float transmitting = p.transmitting_part();
  if (transmitting < 1) add_metallic_roughness(p, p.opaque_dielectric_part(), lobes);
  if (transmitting > 0 && m.thickness > 0) {
    Dielectric<Rgb> solid;
    set_dielectric(m, p, solid);
    lobes.add(solid);
  } else if (transmitting > 0) {
    ThinTransmission<Rgb> thin;
    set_dielectric_fresnel(p, thin);
    set_thin_transmission(p, thin);
    lobes.add(thin);
  }
}

FilmFresnel<Rgb> film_fresnel_at(const SurfaceMaterial& material, const TexturePoint& point, const CoreParameters& p) {
  const Material& m = material.description;
  FilmFresnel<Rgb> fresnel;
  fresnel.dielectric_f0 = p.f0;
  fresnel.dielectric_f90 = p.specular;
  fresnel.metal_f0 = p.base;
  fresnel.dielectric = p.opaque_dielectric_part();
  fresnel.metal = p.metallic;
  fresnel.strength = unit(textured(m.iridescence, material.iridescence, point, 0));
  fresnel.film.ior = m.iridescence_ior;
  const float t = textured(1, material.iridescence_thickness, point, 1);
  fresnel.film.thickness =
      m.iridescence_thickness_min + (m.iridescence_thickness_max - m.iridescence_thickness_min) * t;
  return fresnel;
}

void set_tinted_boundary(const Material& m, const CoreParameters& p, const FilmFresnel<Rgb>& fresnel,
                         TintedBoundary<Rgb>& boundary) {
  boundary.clear_f0 = f0_from_ior(m.ior == 0 ? kPerfectMirrorIor : m.ior);
  boundary.tint = p.specular_color;
  boundary.f0 = p.f0;
  boundary.f90 = p.specular;
  boundary.film = fresnel.film;
  boundary.strength = fresnel.strength;
}

void add_metallic_roughness_with_film(const CoreParameters& p, const FilmFresnel<Rgb>& fresnel, float diffuse_part,
                                      AnyLobeSet<Rgb>& lobes) {
  MetallicRoughness<Rgb, FilmFresnel<Rgb>> lobe;
  static_cast<FilmFresnel<Rgb>&>(lobe) = fresnel;
  lobe.base = p.base * diffuse_part;
  lobe.facets = p.facets;
  if (p.conserves_energy) lobe.conserve_energy();
  lobes.add(lobe);
}

// The lobes below sheen and coat, with iridescence and diffuse transmission.
void add_extended_base(const SurfaceMaterial& material, const TexturePoint& point, const CoreParameters& p,
                       AnyLobeSet<Rgb>& lobes) {
  const Material& m = material.description;
  const float diffuse_transmission = unit(textured(m.diffuse_transmission, material.diffuse_transmission, point, 3));
  const FilmFresnel<Rgb> fresnel = film_fresnel_at(material, point, p);
  const float transmitting = p.transmitting_part();
  if (transmitting < 1) {
    const float diffuse_part = p.opaque_dielectric_part() * (1 - diffuse_transmission);
    if (fresnel.strength > 0)
      add_metallic_roughness_with_film(p, fresnel, diffuse_part, lobes);
    else
      add_metallic_roughness(p, diffuse_part, lobes);
  }
  if (p.opaque_dielectric_part() * diffuse_transmission > 0) {
    DiffuseTransmission<Rgb, FilmFresnel<Rgb>> lobe;
    lobe.color = unit(textured(m.diffuse_transmission_color, material.diffuse_transmission_color, point)) *
                 (p.opaque_dielectric_part() * diffuse_transmission);
    lobe.layer = fresnel;
    if (p.conserves_energy) lobe.conserve_energy(p.facets);
    lobes.add(lobe);
  }
  if (transmitting > 0 && m.thickness > 0) {
    Dielectric<Rgb, TintedBoundary<Rgb>> solid;
    set_tinted_boundary(m, p, fresnel, solid);
    set_dielectric(m, p, solid);
    lobes.add(solid);
  } else if (transmitting > 0) {
    ThinTransmission<Rgb, FilmFresnel<Rgb>> thin;
    static_cast<FilmFresnel<Rgb>&>(thin) = fresnel;
    thin.dielectric = 1;
    thin.metal = 0;
    set_thin_transmission(p, thin);
    lobes.add(thin);
  }
}

void add_sheen(const SurfaceMaterial& material, const TexturePoint& point, AnyLobeSet<Rgb>& lobes) {
  const Material& m = material.description;
  Sheen<Rgb> sheen;
  sheen.color = unit(textured(m.sheen_color, material.sheen_color, point));
  sheen.roughness = unit(textured(m.sheen_roughness, material.sheen_roughness, point, 3));
  if (is_black(sheen.color)) return;
  lobes.add_coating(SheenCoating{max_component(sheen.color), sheen.roughness});
  lobes.add(sheen);
}

void add_clearcoat(const SurfaceMaterial& material, const TexturePoint& point, const Vec3& normal,
                   AnyLobeSet<Rgb>& lobes) {
  const Material& m = material.description;
  Clearcoat<Rgb> coat;
  coat.strength = unit(textured(m.clearcoat, material.clearcoat, point, 0));
  if (coat.strength == 0) return;
  coat.frame = Frame(normal);
  coat.facets = gltf_microfacets(textured(m.clearcoat_roughness, material.clearcoat_roughness, point, 1), 0);
  DielectricCoating coating{.normal = normal, .strength = coat.strength, .f0 = kCoatF0, .f90 = 1};
  if (m.layering == Layering::energy_conserving) coating.alpha = std::max(coat.facets.alpha_x, kSmoothAlpha);
  lobes.add_coating(coating);
  lobes.add(coat);
}

}  // namespace

Ggx gltf_microfacets(float roughness, float anisotropy) {
  const float alpha = sqr(unit(roughness));
  Ggx facets;
  facets.alpha_x = alpha + (1 - alpha) * sqr(unit(anisotropy));
  facets.alpha_y = alpha;
  // Floats cannot represent the density of a lobe that is rough along one axis and smooth along the other.
  if (facets.alpha_x >= kSmoothAlpha) facets.alpha_y = std::max(facets.alpha_y, kSmoothAlpha);
  return facets;
}

void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, StandardLobes<Rgb>& lobes) {
  if (material.is_lambertian) return lobes.add(Lambert<Rgb>{unit(rgb_of(material.base_color_at(point)))});
  add_core_lobes(material.description, metallic_roughness_at(material, point), lobes);
}

void add_lobes(const SurfaceMaterial& material, const TexturePoint& point, AllLobes<Rgb>& all,
               const Vec3& coat_normal) {
  const Material& m = material.description;
  AnyLobeSet<Rgb>& lobes = lobe_set(all);
  if (material.constant_lobes && point.color == Vec4(1)) {
    all = *material.constant_lobes;
  } else if (material.is_lambertian) {
    lobes.add(Lambert<Rgb>{unit(rgb_of(material.base_color_at(point)))});
  } else if (m.model) {
    m.model->add_lobes(unit(rgb_of(material.base_color_at(point))), all);
  } else if (material.uses_standard_lobes) {
    add_core_lobes(m, metallic_roughness_at(material, point), lobes);
  } else if (m.specular_glossiness) {
    add_core_lobes(m, specular_glossiness_at(material, point), lobes);
  } else {
    add_extended_base(material, point, metallic_roughness_at(material, point), lobes);
    if (!is_black(m.sheen_color)) add_sheen(material, point, lobes);
    if (m.clearcoat > 0) add_clearcoat(material, point, coat_normal, lobes);
  }
}

}  // namespace etendue
