// The clear coat of glTF: a dielectric layer with facets and a normal of its own.              KHR_materials_clearcoat
//
//   f = strength F(wo.h) D G2 / (4 |n.wo| |n.wi|) m(wo) m(wi),    m(w) = min(1, |n.w| / |z.w|)
//
// n is the coat's normal, z the shading normal. Reciprocal; m keeps the coat from sending out more than it gets where n
// is not z. Schlick's F is that of an index of 1.5. DielectricCoating (cover.h) is what it leaves to what lies below:
// there the extension takes the angle to the normal, here that to the facet, as the layers below do. Sampled by visible
// normals.
#pragma once
#include "base/frame.h"
#include "bsdf/fresnel/fresnel.h"
#include "bsdf/lobe.h"
#include "bsdf/microfacet/ggx.h"

namespace etendue {

inline constexpr float kCoatF0 = 0.04f;

template <class Color>
struct Clearcoat {
  float strength = 1;
  Frame frame;  // of its normal, in that of the surface
  Ggx facets;

  bool smooth() const { return facets.alpha_x < kSmoothAlpha; }
  bool is_delta() const { return smooth(); }
  float fresnel(float cosine) const { return strength * (kCoatF0 + (1 - kCoatF0) * schlick_weight(cosine)); }
  float sampling_weight(const Vec3& wo) const { return fresnel(std::abs(glm::dot(frame.z, wo))); }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (smooth() || !one_side(wo, wi)) return Color(0);
    const Vec3 o = frame.to_local(wo), i = frame.to_local(wi), h = glm::normalize(o + i);
    const float shape = facets.d(h) * facets.g2(o, i) / (4 * o.z * i.z);
    return Color(fresnel(std::abs(glm::dot(o, h))) * shape * foreshortened(wo, o) * foreshortened(wi, i));
  }

  bool has_component(ScatterType letter) const { return letter == ScatterType::glossy && !smooth(); }
  Color eval_component(ScatterType letter, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return letter == ScatterType::glossy ? eval(wo, wi, mode) : Color(0);
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (smooth() || !one_side(wo, wi)) return 0;
    const Vec3 o = raised(wo), i = raised(wi), h = glm::normalize(o + i);
    return facets.visible_pdf(o, h) / (4 * std::abs(glm::dot(o, h)));
  }

  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const Vec3 o = raised(wo);
    if (!(o.z > 0)) return false;
    const Vec3 h = smooth() ? Vec3(0, 0, 1) : facets.sample_visible(o, random.u);
    const Vec3 i = reflect(o, h);
    s.wi = lowered(i, wo);
    if (!(i.z > 0) || !one_side(wo, s.wi)) return false;
    s.delta = smooth();
    s.type = s.delta ? ScatterType::specular : ScatterType::glossy;
    if (s.delta) return s.weight = mirrored(wo, s.wi), true;
    s.pdf_solid_angle = pdf(wo, s.wi, mode);
    if (!(s.pdf_solid_angle > 0)) return false;
    s.weight = eval(wo, s.wi, mode) * (std::abs(s.wi.z) / s.pdf_solid_angle);
    return true;
  }

  void add_deltas(const Vec3& wo, TransportMode, DeltaSet<Color>& deltas) const {
    if (!smooth()) return;
    const Vec3 o = raised(wo), wi = lowered(Vec3(-o.x, -o.y, o.z), wo);
    if (o.z > 0 && one_side(wo, wi)) deltas.add_reflection(wi, mirrored(wo, wi), 1);
  }

 private:
  // Both on one side of the surface and of the coat, and that the same.
  bool one_side(const Vec3& wo, const Vec3& wi) const {
    return wo.z * wi.z > 0 && glm::dot(frame.z, wo) * wo.z > 0 && glm::dot(frame.z, wi) * wi.z > 0;
  }
  // In the coat's frame, those of the surface's back turned to its front; and back to the side of `like`.
  Vec3 raised(const Vec3& w) const {
    const Vec3 local = frame.to_local(w);
    return w.z < 0 ? Vec3(local.x, local.y, -local.z) : local;
  }
  Vec3 lowered(const Vec3& w, const Vec3& like) const { return frame.to_world(like.z < 0 ? Vec3(w.x, w.y, -w.z) : w); }
  static float foreshortened(const Vec3& w, const Vec3& in_coat) { return std::min(1.0f, std::abs(in_coat.z / w.z)); }
  // The coefficient of the delta: f cos is measured to the shading normal.
  Color mirrored(const Vec3& wo, const Vec3& wi) const {
    const Vec3 o = frame.to_local(wo), i = frame.to_local(wi);
    return Color(fresnel(std::abs(o.z)) * foreshortened(wo, o) * foreshortened(wi, i) * std::abs(wi.z / i.z));
  }
};

}  // namespace etendue
