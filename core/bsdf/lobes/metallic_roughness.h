// The opaque part of glTF's metallic-roughness surface: a specular layer over a diffuse base.
//
//   f = base/pi (1 - max F_d(wo.h)) + F(wo.h) D G2 / (4 cos_o cos_i)               glTF 2.0, appendix B
//
// F is Schlick's with f0 and f90 mixed between dielectric and metal (or that of a film), F_d the dielectric's alone, by
// which the base is attenuated. Reciprocal (h is symmetric in wo and wi). Energy is the specification's: the layer
// alone loses what is scattered more than once between facets; over a bright base the sum gains at grazing angles
// (albedo up to 1.7 at 88 degrees), because 1 - F(wo.h) is more than the layer leaves. Below kSmoothAlpha the layer is
// a mirror. Sampling: cosine for the base, visible normals for the layer, chosen by their estimated albedo.
#pragma once
#include "base/warp.h"
#include "bsdf/fresnel/schlick_fresnel.h"
#include "bsdf/lobe.h"
#include "bsdf/microfacet/ggx.h"

namespace etendue {

// Fresnel is SchlickFresnel, or what offers the same: FilmFresnel.
template <class Color, class Fresnel = SchlickFresnel<Color>>
struct MetallicRoughness : Fresnel {
  Color base{0};  // diffuse albedo under the layer, zero for a metal
  Ggx facets;

  using Fresnel::fresnel, Fresnel::kept;

  bool is_delta() const { return false; }
  bool smooth() const { return facets.alpha_x < kSmoothAlpha && facets.alpha_y < kSmoothAlpha; }

  Color under(float cosine) const { return base * (1 - kept(cosine)); }

  float sampling_weight(const Vec3& wo) const {
    const float c = std::abs(wo.z);
    return average(under(c)) + average(fresnel(c));
  }

  float specular_share(const Vec3& wo) const {
    const float c = std::abs(wo.z);
    const float layer = average(fresnel(c)), diffuse = average(under(c));
    return layer > 0 ? (diffuse > 0 ? std::clamp(layer / (layer + diffuse), 0.1f, 0.95f) : 1.0f) : 0.0f;
  }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (wo.z * wi.z <= 0) return Color(0);
    const Vec3 h = glm::normalize(wo + wi);
    const float c = std::abs(glm::dot(wo, h));
    Color f = under(c) * kInvPi;
    if (!smooth()) f += fresnel(c) * (facets.d(h) * facets.g2(wo, wi) / (4 * wo.z * wi.z));
    return f;
  }

  bool has_component(ScatterType letter) const {
    return letter == ScatterType::diffuse ? !is_black(base)
                                          : letter == ScatterType::glossy && !smooth() && this->reflects();
  }
  // The base is D, the layer G.
  Color eval_component(ScatterType letter, const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (!has_component(letter) || wo.z * wi.z <= 0) return Color(0);
    const Vec3 h = glm::normalize(wo + wi);
    const float c = std::abs(glm::dot(wo, h));
    if (letter == ScatterType::diffuse) return under(c) * kInvPi;
    return fresnel(c) * (facets.d(h) * facets.g2(wo, wi) / (4 * wo.z * wi.z));
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (wo.z * wi.z <= 0) return 0;
    const float share = specular_share(wo);
    float p = (1 - share) * cosine_hemisphere_pdf(std::abs(wi.z));
    if (share > 0 && !smooth()) p += share * layer_pdf(wo, wi);
    return p;
  }

  bool sample(const Vec3& wo_any, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const float side = wo_any.z < 0 ? -1.0f : 1.0f;
    const Vec3 wo = Vec3(wo_any.x, wo_any.y, side * wo_any.z);
    const float share = specular_share(wo);
    if (random.choice < share && smooth()) {
      s.wi = Vec3(-wo.x, -wo.y, side * wo.z);
      s.weight = fresnel(wo.z) / share;
      s.pdf_solid_angle = 0;
      s.delta = true;
      s.type = ScatterType::specular;
      return true;
    }
    if (random.choice < share) {
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
    if (smooth()) deltas.add_reflection(Vec3(-wo.x, -wo.y, wo.z), fresnel(std::abs(wo.z)), specular_share(wo));
  }

 private:
  float layer_pdf(Vec3 wo, Vec3 wi) const {
    if (wo.z < 0) wo.z = -wo.z, wi.z = -wi.z;
    const Vec3 h = glm::normalize(wo + wi);
    return facets.visible_pdf(wo, h) / (4 * std::abs(glm::dot(wo, h)));
  }
};

}  // namespace etendue
