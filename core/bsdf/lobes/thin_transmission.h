// The glTF transmission of a thin surface, which does not refract.                      [KHR_materials_transmission]
//
//   f_r = F D G2 / (4 cos_o cos_i)
//   f_t = tint (1 - max F) D G2 / (4 cos_o cos_i),     with wi mirrored to the side of wo
//
// One interface: the transmitted lobe is the reflected lobe mirrored to the other side. Reciprocal. Conserves energy;
// the microfacets lose what they scatter more than once. Sampling: visible normals, then reflection or transmission.
#pragma once
#include "bsdf/fresnel/schlick_fresnel.h"
#include "bsdf/lobe.h"
#include "bsdf/microfacet/ggx.h"

namespace etendue {

template <class Color, class Fresnel = SchlickFresnel<Color>>
struct ThinTransmission : Fresnel {
  Color tint{1};
  float share = 1;  // weight of this lobe in the surface's mixture
  Ggx facets;

  using Fresnel::fresnel, Fresnel::layer_reflectance;

  bool smooth() const { return facets.alpha_x < kSmoothAlpha && facets.alpha_y < kSmoothAlpha; }
  bool is_delta() const { return smooth(); }
  float sampling_weight(const Vec3& wo) const {
    const GgxAlbedo e = ggx_albedo(facets, wo);
    return share * (average(this->albedo(e)) + average(tint) * std::max(0.0f, e.total() - this->layer_albedo(e)));
  }

  // In proportion to the energy of both sides; bounded away from 0 and 1, so that both are sampled.
  float reflection_probability(float cosine) const {
    const float reflected = average(fresnel(cosine)), passed = average(transmittance(cosine));
    return reflected > 0 ? std::clamp(reflected / (reflected + passed), 0.05f, 0.95f) : 0.05f;
  }
  Color transmittance(float cosine) const { return tint * (1 - layer_reflectance(cosine)); }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (smooth() || wo.z * wi.z == 0) return Color(0);
    const bool reflection = wo.z * wi.z > 0;
    const Vec3 mirrored = reflection ? wi : Vec3(wi.x, wi.y, -wi.z);
    const Vec3 h = glm::normalize(wo + mirrored);
    const float c = std::abs(glm::dot(wo, h));
    const float shape = facets.d(h) * facets.g2(wo, mirrored) / (4 * std::abs(wo.z * wi.z));
    return (reflection ? fresnel(c) : transmittance(c)) * (shape * share);
  }

  bool has_component(ScatterType type) const { return type == ScatterType::glossy && !is_delta(); }
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return type == ScatterType::glossy ? eval(wo, wi, mode) : Color(0);
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (smooth() || wo.z * wi.z == 0) return 0;
    const bool reflection = wo.z * wi.z > 0;
    const float side = wo.z < 0 ? -1.0f : 1.0f;
    const Vec3 h = glm::normalize(wo + (reflection ? wi : Vec3(wi.x, wi.y, -wi.z)));
    const float c = std::abs(glm::dot(wo, h));
    const float p = facets.visible_pdf(wo * side, h * side) / (4 * c);
    return p * (reflection ? reflection_probability(c) : 1 - reflection_probability(c));
  }

  bool sample(const Vec3& wo_any, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const float side = wo_any.z < 0 ? -1.0f : 1.0f;
    const Vec3 wo(wo_any.x, wo_any.y, wo_any.z * side);
    const Vec3 h = smooth() ? Vec3(0, 0, 1) : facets.sample_visible(wo, random.u);
    const float c = glm::dot(wo, h);
    const float reflection = reflection_probability(c);
    s.wi = reflect(wo, h);
    if (s.wi.z <= 0) return false;
    s.transmitted = random.choice >= reflection;
    if (s.transmitted) s.wi.z = -s.wi.z;
    s.wi.z *= side;
    s.delta = smooth();
    s.type = s.delta ? ScatterType::specular : ScatterType::glossy;
    if (s.delta) {
      s.weight = s.transmitted ? transmittance(c) * (share / (1 - reflection)) : fresnel(c) * (share / reflection);
      return true;
    }
    s.pdf_solid_angle = pdf(wo_any, s.wi, mode);
    if (!(s.pdf_solid_angle > 0)) return false;
    s.weight = eval(wo_any, s.wi, mode) * (std::abs(s.wi.z) / s.pdf_solid_angle);
    return true;
  }

  void add_deltas(const Vec3& wo, TransportMode, DeltaSet<Color>& deltas) const {
    if (!smooth()) return;
    const float c = std::abs(wo.z);
    const float reflection = reflection_probability(c);
    deltas.add_reflection(Vec3(-wo.x, -wo.y, wo.z), fresnel(c) * share, reflection);
    deltas.add_transmission(-wo, transmittance(c) * share, 1, 1 - reflection);
  }
};

}  // namespace etendue
