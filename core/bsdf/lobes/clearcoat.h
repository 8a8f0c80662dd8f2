// The clear coat of glTF: a dielectric layer with its own normal and roughness.              [KHR_materials_clearcoat]
//
//   f = strength F(<wo, h>) D G2 / (4 |<n, wo>| |<n, wi>|) m(wo) m(wi),     m(w) = min(1, |<n, w>| / |<z, w>|)
//
// n is the normal of the coat, z the shading normal. F is Schlick's term with f0 = 0.04, an index of refraction of 1.5.
// Reciprocal. The factors m keep the coat from reflecting more than it receives where n differs from z. Sampled by
// visible normals. DielectricCoating (coating_layers.h) attenuates the lobes below. The extension evaluates F at the
// angle to the normal; the angle to the microfacet is used here, as in the layers below.
#pragma once
#include "base/frame.h"
#include "bsdf/fresnel/fresnel.h"
#include "bsdf/lobe.h"
#include "bsdf/microfacet/ggx_albedo.h"

namespace etendue {

// Reflectance of the coat at normal incidence.
inline constexpr float kCoatF0 = 0.04f;

template <class Color>
struct Clearcoat {
  float strength = 1;
  Frame frame;  // around the coat's normal, in the shading frame
  Ggx facets;

  bool smooth() const { return facets.alpha_x < kSmoothAlpha; }
  bool is_delta() const { return smooth(); }
  float fresnel(float cosine) const { return strength * (kCoatF0 + (1 - kCoatF0) * schlick_weight(cosine)); }
  float sampling_weight(const Vec3& wo) const {
    const GgxAlbedo e = ggx_albedo(facets, frame.to_local(wo));
    return strength * (kCoatF0 * e.a + e.b);
  }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (smooth() || !same_side(wo, wi)) return Color(0);
    const Vec3 o = frame.to_local(wo), i = frame.to_local(wi), h = glm::normalize(o + i);
    const float shape = facets.d(h) * facets.g2(o, i) / (4 * o.z * i.z);
    return Color(fresnel(std::abs(glm::dot(o, h))) * shape * foreshortening(wo, o) * foreshortening(wi, i));
  }

  bool has_component(ScatterType type) const { return type == ScatterType::glossy && !smooth(); }
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return type == ScatterType::glossy ? eval(wo, wi, mode) : Color(0);
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (smooth() || !same_side(wo, wi)) return 0;
    const Vec3 o = to_coat(wo), i = to_coat(wi);
    return facets.reflection_pdf(o, glm::normalize(o + i));
  }

  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const Vec3 o = to_coat(wo);
    if (!(o.z > 0)) return false;
    const Vec3 i = smooth() ? Vec3(-o.x, -o.y, o.z) : facets.sample_reflection(o, random.u);
    s.wi = from_coat(i, wo);
    if (!(i.z > 0) || !same_side(wo, s.wi)) return false;
    s.delta = smooth();
    s.type = s.delta ? ScatterType::specular : ScatterType::glossy;
    if (s.delta) {
      s.weight = delta_coefficient(wo, s.wi);
      return true;
    }
    s.pdf_solid_angle = pdf(wo, s.wi, mode);
    if (!(s.pdf_solid_angle > 0)) return false;
    s.weight = eval(wo, s.wi, mode) * (std::abs(s.wi.z) / s.pdf_solid_angle);
    return true;
  }

  void add_deltas(const Vec3& wo, TransportMode, DeltaSet<Color>& deltas) const {
    if (!smooth()) return;
    const Vec3 o = to_coat(wo), wi = from_coat(Vec3(-o.x, -o.y, o.z), wo);
    if (o.z > 0 && same_side(wo, wi)) deltas.add_reflection(wi, delta_coefficient(wo, wi), 1);
  }

 private:
  // Whether both directions lie on the same side of the surface, and the coat's normal agrees.
  bool same_side(const Vec3& wo, const Vec3& wi) const {
    return wo.z * wi.z > 0 && glm::dot(frame.z, wo) * wo.z > 0 && glm::dot(frame.z, wi) * wi.z > 0;
  }
  // To the frame of the coat; directions on the back of the surface are mirrored to its front.
  Vec3 to_coat(const Vec3& w) const {
    const Vec3 local = frame.to_local(w);
    return w.z < 0 ? Vec3(local.x, local.y, -local.z) : local;
  }
  // From the frame of the coat, to the side of the surface on which `wo` lies.
  Vec3 from_coat(const Vec3& w, const Vec3& wo) const { return frame.to_world(wo.z < 0 ? Vec3(w.x, w.y, -w.z) : w); }
  // The factor m.
  static float foreshortening(const Vec3& w, const Vec3& in_coat) { return std::min(1.0f, std::abs(in_coat.z / w.z)); }
  // The coefficient of the delta of a smooth coat. Its cosine is that to the shading normal.
  Color delta_coefficient(const Vec3& wo, const Vec3& wi) const {
    const Vec3 o = frame.to_local(wo), i = frame.to_local(wi);
    return Color(fresnel(std::abs(o.z)) * foreshortening(wo, o) * foreshortening(wi, i) * std::abs(wi.z / i.z));
  }
};

}  // namespace etendue
