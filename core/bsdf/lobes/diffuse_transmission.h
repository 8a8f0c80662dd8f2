// Diffuse transmission below a specular layer.                                   [KHR_materials_diffuse_transmission]
//
//   f = color / pi (1 - max(F(cos_o), F(cos_i)))
//
// F is the reflectance of the specular layer. The extension does not define the angle for directions on opposite sides;
// the angles to the normal make f reciprocal and, over a smooth layer, energy conserving. The energy-conserving form of
// layered_base.h can replace the factor. Sampled by the cosine on the other side.
#pragma once
#include "base/warp.h"
#include "bsdf/lobe.h"
#include "bsdf/lobes/layered_base.h"

namespace etendue {

template <class Color, class Fresnel>
struct DiffuseTransmission {
  Color color{0};
  Fresnel layer;
  Ggx layer_facets;         // read by energy-conserving layering only
  float normalization = 0;  // as in MetallicRoughness

  // Selects energy-conserving layering below these microfacets. The layer must be set.
  void conserve_energy(const Ggx& facets) {
    layer_facets = facets;
    normalization = layer_normalization(layer, facets);
  }

  bool is_delta() const { return false; }
  float sampling_weight(const Vec3& wo) const {
    const float transmittance =
        normalization > 0 ? layer_transmittance(layer, layer_facets, wo) : 1 - layer.layer_reflectance(std::abs(wo.z));
    return average(color) * transmittance;
  }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (!(wo.z * wi.z < 0)) return Color(0);
    if (normalization > 0) return color * (kInvPi * coupled_transmittance(layer, layer_facets, normalization, wo, wi));
    return color *
           (kInvPi * (1 - std::max(layer.layer_reflectance(std::abs(wo.z)), layer.layer_reflectance(std::abs(wi.z)))));
  }

  bool has_component(ScatterType type) const { return type == ScatterType::diffuse && !is_black(color); }
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return type == ScatterType::diffuse ? eval(wo, wi, mode) : Color(0);
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode) const {
    return wo.z * wi.z < 0 ? cosine_hemisphere_pdf(std::abs(wi.z)) : 0;
  }

  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    s.wi = random.cosine_direction;
    s.pdf_solid_angle = cosine_hemisphere_pdf(s.wi.z);
    if (!(s.pdf_solid_angle > 0)) return false;
    if (wo.z > 0) s.wi.z = -s.wi.z;
    s.weight = eval(wo, s.wi, mode) * (std::abs(s.wi.z) / s.pdf_solid_angle);
    s.transmitted = true;
    s.type = ScatterType::diffuse;
    return true;
  }

  void add_deltas(const Vec3&, TransportMode, DeltaSet<Color>&) const {}
};

}  // namespace etendue
