// The opaque part of the glTF metallic-roughness material: a specular layer over a diffuse base. [glTF 2.0, appendix B]
//
//   f = base / pi (1 - max F_d(<wo, h>)) + F(<wo, h>) D G2 / (4 cos_o cos_i)
//
// F is Schlick's term with f0 and f90 of the mixture of dielectric and metal, or that of a thin film. F_d is the term
// of the dielectric alone; the base is attenuated by its largest colour component. A roughness below kSmoothAlpha makes
// the layer a mirror. Reciprocal. Energy is that of the specification: the layer alone loses what its microfacets
// scatter more than once. Over a bright base the sum gains energy at grazing angles (albedo up to 1.7 at 88 degrees),
// because 1 - F_d(<wo, h>) is more than the layer transmits. Sampling: cosine for the base, visible normals for the
// layer, selected by their estimated albedos.
#pragma once
#include "base/warp.h"
#include "bsdf/fresnel/schlick_fresnel.h"
#include "bsdf/lobe.h"
#include "bsdf/microfacet/ggx.h"

namespace etendue {

// Fresnel is SchlickFresnel or FilmFresnel.
template <class Color, class Fresnel = SchlickFresnel<Color>>
struct MetallicRoughness : Fresnel {
  Color base{0};  // diffuse albedo below the layer, 0 for a metal
  Ggx facets;

  using Fresnel::fresnel, Fresnel::layer_reflectance;

  bool is_delta() const { return false; }
  bool smooth() const { return facets.alpha_x < kSmoothAlpha && facets.alpha_y < kSmoothAlpha; }

  // The albedo of the base as seen through the layer.
  Color attenuated_base(float cosine) const { return base * (1 - layer_reflectance(cosine)); }

  float sampling_weight(const Vec3& wo) const {
    const float c = std::abs(wo.z);
    return average(attenuated_base(c)) + average(fresnel(c));
  }

  // The probability of sampling the layer.
  float specular_probability(const Vec3& wo) const {
    const float c = std::abs(wo.z);
    const float layer = average(fresnel(c)), diffuse = average(attenuated_base(c));
    return layer > 0 ? (diffuse > 0 ? std::clamp(layer / (layer + diffuse), 0.1f, 0.95f) : 1.0f) : 0.0f;
  }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (wo.z * wi.z <= 0) return Color(0);
    const Vec3 h = glm::normalize(wo + wi);
    const float c = std::abs(glm::dot(wo, h));
    Color f = attenuated_base(c) * kInvPi;
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
    if (type == ScatterType::diffuse) return attenuated_base(c) * kInvPi;
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
      s.wi = reflect(wo, facets.sample_visible(wo, random.u));
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
  // Density of sampling the layer, per solid angle of wi.
  float layer_pdf(Vec3 wo, Vec3 wi) const {
    if (wo.z < 0) {
      wo.z = -wo.z;
      wi.z = -wi.z;
    }
    const Vec3 h = glm::normalize(wo + wi);
    return facets.visible_pdf(wo, h) / (4 * std::abs(glm::dot(wo, h)));
  }
};

}  // namespace etendue
