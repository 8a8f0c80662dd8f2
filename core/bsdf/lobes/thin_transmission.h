// A thin sheet that reflects and lets through without bending: glTF's transmission without a volume.
//
//   f_r = F D G2 / (4 cos_o cos_i),   f_t = (1 - F) f_r(wo, mirrored wi) / F        KHR_materials_transmission
//
// The transmitted lobe is the reflected one, turned to the other side. Reciprocal; conserves energy as Layered does.
#pragma once
#include "bsdf/fresnel/schlick_fresnel.h"
#include "bsdf/lobe.h"
#include "bsdf/microfacet/ggx.h"

namespace etendue {

template <class Color, class Fresnel = SchlickFresnel<Color>>
struct ThinTransmission : Fresnel {
  Color tint{1};
  float share = 1;
  Ggx facets;

  using Fresnel::fresnel, Fresnel::kept;

  bool smooth() const { return facets.alpha_x < kSmoothAlpha && facets.alpha_y < kSmoothAlpha; }
  bool is_delta() const { return smooth(); }
  float sampling_weight(const Vec3&) const { return share; }

  float reflect_share(float cosine) const { return std::clamp(average(fresnel(cosine)), 0.05f, 0.95f); }
  Color passed(float cosine) const { return tint * (1 - kept(cosine)); }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (smooth() || wo.z * wi.z == 0) return Color(0);
    const bool reflection = wo.z * wi.z > 0;
    const Vec3 mirrored = reflection ? wi : Vec3(wi.x, wi.y, -wi.z);
    const Vec3 h = glm::normalize(wo + mirrored);
    const float c = std::abs(glm::dot(wo, h));
    const float shape = facets.d(h) * facets.g2(wo, mirrored) / (4 * std::abs(wo.z * wi.z));
    return (reflection ? fresnel(c) : passed(c)) * (shape * share);
  }

  bool has_component(ScatterType letter) const { return letter == ScatterType::glossy && !is_delta(); }
  Color eval_component(ScatterType letter, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return letter == ScatterType::glossy ? eval(wo, wi, mode) : Color(0);
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (smooth() || wo.z * wi.z == 0) return 0;
    const bool reflection = wo.z * wi.z > 0;
    const float side = wo.z < 0 ? -1.0f : 1.0f;
    const Vec3 h = glm::normalize(wo + (reflection ? wi : Vec3(wi.x, wi.y, -wi.z)));
    const float c = std::abs(glm::dot(wo, h));
    const float p = facets.visible_pdf(wo * side, h * side) / (4 * c);
    return p * (reflection ? reflect_share(c) : 1 - reflect_share(c));
  }

  bool sample(const Vec3& wo_any, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const float side = wo_any.z < 0 ? -1.0f : 1.0f;
    const Vec3 wo(wo_any.x, wo_any.y, wo_any.z * side);
    const Vec3 h = smooth() ? Vec3(0, 0, 1) : facets.sample_visible(wo, random.u);
    const float c = glm::dot(wo, h);
    const float reflect_probability = reflect_share(c);
    s.wi = reflect(wo, h);
    if (s.wi.z <= 0) return false;
    s.transmitted = random.choice >= reflect_probability;
    if (s.transmitted) s.wi.z = -s.wi.z;
    s.wi.z *= side;
    s.delta = smooth();
    s.type = s.delta ? ScatterType::specular : ScatterType::glossy;
    if (s.delta) {
      s.weight =
          s.transmitted ? passed(c) * (share / (1 - reflect_probability)) : fresnel(c) * (share / reflect_probability);
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
    const float reflected = reflect_share(c);
    deltas.add_reflection(Vec3(-wo.x, -wo.y, wo.z), fresnel(c) * share, reflected);
    deltas.add_transmission(-wo, passed(c) * share, 1, 1 - reflected);
  }
};

}  // namespace etendue
