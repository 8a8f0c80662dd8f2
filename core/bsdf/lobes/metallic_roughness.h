// The opaque part of the glTF metallic-roughness material: a specular layer over a diffuse base. [glTF 2.0, appendix B]
//
//   f = base / pi T(o, i) + F(<wo, h>) D G2 / (4 cos_o cos_i)
//
// F is Schlick's term with f0 and f90 of the mixture of dielectric and metal, or that of a thin film. T is the light
// that the layer leaves to the base (layered_base.h): 1 - max F_d(<wo, h>) as in glTF, with the term F_d of the
// dielectric alone and its largest colour component, or the energy-conserving form. A roughness below kSmoothAlpha
// makes the layer a mirror. Reciprocal. The layer loses what its microfacets scatter more than once. With the layering
// of glTF, a bright base gains energy at grazing angles, because 1 - F_d(<wo, h>) is more than the layer transmits.
// Sampling: cosine for the base, visible normals for the layer, selected by their albedos in direction wo.
#pragma once
#include "base/warp.h"
#include "bsdf/fresnel/schlick_fresnel.h"
#include "bsdf/lobe.h"
#include "bsdf/lobes/layered_base.h"

namespace etendue {

// Fresnel is SchlickFresnel or FilmFresnel.
template <class Color, class Fresnel = SchlickFresnel<Color>>
struct MetallicRoughness : Fresnel {
  Color base{0};  // diffuse albedo below the layer, 0 for a metal
  Ggx facets;
  float normalization = 0;  // of energy-conserving layering (layered_base.h); 0 selects the layering of glTF

  using Fresnel::fresnel, Fresnel::layer_reflectance;

  // Selects energy-conserving layering. Base, Fresnel term and microfacets must be set.
  void conserve_energy() { normalization = layer_normalization(*this, facets); }

  bool is_delta() const { return false; }
  bool smooth() const { return facets.alpha_x < kSmoothAlpha && facets.alpha_y < kSmoothAlpha; }

  // Estimates of the directional albedos, averaged over the colour components.
  struct Albedos {
    float layer = 0, base = 0;
  };
  Albedos albedos(const Vec3& wo) const {
    const GgxAlbedo e = ggx_albedo(facets, wo);
    return {average(this->albedo(e)), average(base) * mean_transmittance(wo)};
  }

  float sampling_weight(const Vec3& wo) const {
    const Albedos a = albedos(wo);
    return a.layer + a.base;
  }

  // The probability of sampling the layer. It is bounded, because lights are not uniform.
  float specular_probability(const Vec3& wo) const {
    if (!this->reflects()) return 0;
    if (is_black(base)) return 1;
    const Albedos a = albedos(wo);
    return std::clamp(a.layer / (a.layer + a.base), 0.1f, 0.95f);
  }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (wo.z * wi.z <= 0) return Color(0);
    const Vec3 h = glm::normalize(wo + wi);
    const float c = std::abs(glm::dot(wo, h));
    Color f = base * (transmittance(wo, wi, c) * kInvPi);
    if (!smooth()) f += fresnel(c) * (facets.d(h) * facets.g2(wo, wi) / (4 * wo.z * wi.z));
    return f;
  }

  bool has_component(ScatterType type) const {
    return type == ScatterType::diffuse ? !is_black(base)
                                        : type == ScatterType::glossy && !smooth() && this->reflects();
  }
  // The base is diffuse, the layer glossy.
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (!has_component(type) || wo.z * wi.z <= 0) return Color(0);
    const Vec3 h = glm::normalize(wo + wi);
    const float c = std::abs(glm::dot(wo, h));
    if (type == ScatterType::diffuse) return base * (transmittance(wo, wi, c) * kInvPi);
    return fresnel(c) * (facets.d(h) * facets.g2(wo, wi) / (4 * wo.z * wi.z));
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (wo.z * wi.z <= 0) return 0;
    const float layer = specular_probability(wo);
    float p = (1 - layer) * cosine_hemisphere_pdf(std::abs(wi.z));
    if (layer > 0 && !smooth()) p += layer * layer_pdf(wo, wi);
    return p;
  }

  bool sample(const Vec3& wo_any, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const float side = wo_any.z < 0 ? -1.0f : 1.0f;
    const Vec3 wo = Vec3(wo_any.x, wo_any.y, side * wo_any.z);
    const float layer = specular_probability(wo);
    if (random.choice < layer && smooth()) {
      s.wi = Vec3(-wo.x, -wo.y, side * wo.z);
      s.weight = fresnel(wo.z) / layer;
      s.pdf_solid_angle = 0;
      s.delta = true;
      s.type = ScatterType::specular;
      return true;
    }
    if (random.choice < layer) {
      s.wi = facets.sample_reflection(wo, random.u);
      s.type = ScatterType::glossy;
    } else {
      s.wi = random.cosine_direction;
      s.type = ScatterType::diffuse;
    }
    if (s.wi.z <= 0) return false;
    s.pdf_solid_angle = pdf(wo, s.wi, mode);
    if (!(s.pdf_solid_angle > 0)) return false;
    s.weight = eval(wo, s.wi, mode) * (s.wi.z / s.pdf_solid_angle);
    s.wi.z *= side;
    return true;
  }

  void add_deltas(const Vec3& wo, TransportMode, DeltaSet<Color>& deltas) const {
    if (smooth()) deltas.add_reflection(Vec3(-wo.x, -wo.y, wo.z), fresnel(std::abs(wo.z)), specular_probability(wo));
  }

 private:
  // T, with the cosine of both directions to the half vector.
  float transmittance(const Vec3& wo, const Vec3& wi, float cosine) const {
    return normalization > 0 ? coupled_transmittance(*this, facets, normalization, wo, wi)
                             : 1 - layer_reflectance(cosine);
  }
  // T averaged over the directions of the cosine. The half vectors of wo and of these directions are represented by a
  // cosine of (1 + cos_o) / 2 to wo, which underestimates T by at most 0.006.
  float mean_transmittance(const Vec3& wo) const {
    return normalization > 0 ? layer_transmittance(*this, facets, wo)
                             : 1 - layer_reflectance(0.5f + 0.5f * std::abs(wo.z));
  }
  // Density of sampling the layer, per solid angle of wi.
  float layer_pdf(Vec3 wo, Vec3 wi) const {
    if (wo.z < 0) {
      wo.z = -wo.z;
      wi.z = -wi.z;
    }
    return facets.reflection_pdf(wo, glm::normalize(wo + wi));
  }
};

}  // namespace etendue
