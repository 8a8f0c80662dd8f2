// The boundary of a solid dielectric, smooth or rough: reflection and refraction.                [Walter et al. 2007]
//
//   f_r = F D G2 / (4 |cos_o cos_i|)
//   f_t = (1 - F) D G2 |<wo, h> <wi, h>| / (|cos_o cos_i| (<wi, h> + <wo, h> / eta')^2)    [x 1 / eta'^2 for radiance]
//
// F is exact, or modified by a thin film and KHR_materials_specular (dielectric_boundary.h). eta is the index of
// refraction inside (z < 0) over that outside (z > 0), eta' that on the side of wi over that on the side of wo.
// Refraction scales radiance by eta'^2, not power [Lang, eq. 4.127, 4.130 (corrected), 4.131]. A smooth boundary is a
// pair of deltas. Reciprocal up to the eta^2 law [Lang, eq. 4.301]. Conserves energy; microfacets lose what is
// scattered more than once. Sampling: visible normals, then reflection or refraction in proportion to their energy.
#pragma once
#include "bsdf/lobe.h"
#include "bsdf/lobes/dielectric_boundary.h"
#include "bsdf/microfacet/ggx.h"

namespace etendue {

template <class Color, class Boundary = ClearBoundary<Color>>
struct Dielectric : Boundary {
  Color tint{1};  // multiplies the transmitted light
  float eta = 1.5f;
  float share = 1;  // weight of this lobe in the surface's mixture
  Ggx facets;

  // For a boundary between two media: the index inside over that outside, and the index outside.
  void set_relative_eta(float relative, float outside_eta) {
    eta = relative;
    this->set_media(relative, outside_eta);
  }

  bool smooth() const { return facets.alpha_x < kSmoothAlpha && facets.alpha_y < kSmoothAlpha; }
  bool is_delta() const { return smooth() || eta == 1; }
  // Microfacets are represented by the normal.
  float sampling_weight(const Vec3& wo) const {
    const Incidence at = incidence(wo, std::abs(wo.z), relative_eta(wo));
    return average(reflected(at)) + average(passed(at));
  }

  float relative_eta(const Vec3& wo) const { return wo.z > 0 ? eta : 1 / eta; }
  Color reflected(const Incidence& at) const { return this->reflectance(at) * share; }
  Color passed(const Incidence& at) const { return tint * ((1 - this->kept(at)) * share); }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    Vec3 h;
    Incidence at;
    if (is_delta() || !half_vector(wo, wi, h, at)) return Color(0);
    const float common = facets.d(h) * facets.g2(wo, wi) / std::abs(wo.z * wi.z);
    if (wo.z * wi.z > 0) return reflected(at) * (common / 4);
    const float e = relative_eta(wo);
    const float oh = glm::dot(wo, h), ih = glm::dot(wi, h);
    const float scale = mode == TransportMode::radiance ? 1 / sqr(e) : 1;
    return passed(at) * (common * std::abs(oh * ih) / sqr(ih + oh / e) * scale);
  }

  bool has_component(ScatterType type) const { return type == ScatterType::glossy && !is_delta(); }
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return type == ScatterType::glossy ? eval(wo, wi, mode) : Color(0);
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode) const {
    Vec3 h;
    Incidence at;
    if (is_delta() || !half_vector(wo, wi, h, at)) return 0;
    const float f = this->reflect_share(at, average(tint));
    const float side = wo.z < 0 ? -1.0f : 1.0f;
    const float visible = facets.visible_pdf(wo * side, h * (glm::dot(wo * side, h) < 0 ? -1.0f : 1.0f));
    if (wo.z * wi.z > 0) return f * visible / (4 * std::abs(glm::dot(wo, h)));
    const float ih = glm::dot(wi, h);
    return (1 - f) * visible * std::abs(ih) / sqr(ih + glm::dot(wo, h) / relative_eta(wo));
  }

  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const float side = wo.z < 0 ? -1.0f : 1.0f;
    const bool delta = is_delta();
    const Vec3 h = delta ? Vec3(0, 0, side) : facets.sample_visible(wo * side, random.u) * side;
    const float e = relative_eta(wo);
    const float oh = glm::dot(wo, h);
    if (!(oh > 0)) return false;
    const Incidence at = incidence(wo, oh, e);
    const float f = this->reflect_share(at, average(tint));
    s.delta = delta;
    s.type = delta ? ScatterType::specular : ScatterType::glossy;
    if (random.choice < f) {
      s.wi = reflect(wo, h);
      if (s.wi.z * wo.z <= 0) return false;
      if (delta) return s.weight = reflected(at) / f, true;
    } else {
      s.wi = -wo / e + h * (oh / e - at.refracted);
      s.transmitted = true;
      s.eta = e;
      if (s.wi.z * wo.z >= 0) return false;
      if (delta) return s.weight = passed(at) * ((mode == TransportMode::radiance ? 1 / sqr(e) : 1) / (1 - f)), true;
    }
    s.pdf_solid_angle = pdf(wo, s.wi, mode);
    if (!(s.pdf_solid_angle > 0)) return false;
    s.weight = eval(wo, s.wi, mode) * (std::abs(s.wi.z) / s.pdf_solid_angle);
    return true;
  }

  void add_deltas(const Vec3& wo, TransportMode mode, DeltaSet<Color>& deltas) const {
    if (!is_delta()) return;
    const Vec3 h(0, 0, wo.z < 0 ? -1.0f : 1.0f);
    const float e = relative_eta(wo), oh = std::abs(wo.z);
    const Incidence at = incidence(wo, oh, e);
    const float f = this->reflect_share(at, average(tint));
    deltas.add_reflection(reflect(wo, h), reflected(at), f);
    if (f < 1)
      deltas.add_transmission(-wo / e + h * (oh / e - at.refracted),
                              passed(at) * (mode == TransportMode::radiance ? 1 / sqr(e) : 1), e, 1 - f);
  }

 private:
  static Incidence incidence(const Vec3& wo, float cosine, float e) {
    Incidence at;
    if (e == 1) {
      // Equal media: rounding errors would reflect light and bend the path.
      at.f = 0;
      at.refracted = cosine;
    } else {
      at.f = fresnel_dielectric(cosine, e, at.refracted);
    }
    at.outer = wo.z > 0 ? cosine : at.refracted;
    return at;
  }

  // The microfacet normal, on the outer side, that scatters wo to wi, and the incidence on it; false if there is none.
  bool half_vector(const Vec3& wo, const Vec3& wi, Vec3& h, Incidence& at) const {
    const bool reflection = wo.z * wi.z > 0;
    if (wo.z == 0 || wi.z == 0) return false;
    const float e = relative_eta(wo);
    h = reflection ? wo + wi : wo + wi * e;
    const float squared = length_squared(h);
    if (!(squared > 0)) return false;
    h /= std::sqrt(squared);
    if (h.z < 0) h = -h;
    // Back-facing microfacets do not contribute.
    if (glm::dot(wo, h) * wo.z <= 0 || glm::dot(wi, h) * wi.z <= 0) return false;
    const float oh = std::abs(glm::dot(wo, h)), ih = std::abs(glm::dot(wi, h));
    // Near total reflection, the given refracted cosine is more accurate than one computed from the other cosine.
    at = reflection ? incidence(wo, oh, e) : Incidence{fresnel_of_cosines(oh, ih, e), ih, wo.z > 0 ? oh : ih};
    return true;
  }
};

}  // namespace etendue
