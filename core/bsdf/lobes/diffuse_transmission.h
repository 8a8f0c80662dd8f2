// Light that leaves on the other side in all directions alike, under the specular layer.
//                                                                             KHR_materials_diffuse_transmission
//   f = color/pi (1 - max(F(cos_o), F(cos_i)))
//
// F is what the layer above keeps. The extension leaves open which angle that is across a surface: with the angles to
// the normal f is reciprocal and gains no energy. Sampled by the cosine.
#pragma once
#include "base/warp.h"
#include "bsdf/lobe.h"

namespace etendue {

template <class Color, class Fresnel>
struct DiffuseTransmission {
  Color color{0};
  Fresnel layer;

  bool is_delta() const { return false; }
  float sampling_weight(const Vec3& wo) const { return average(color) * (1 - layer.kept(std::abs(wo.z))); }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode) const {
    if (!(wo.z * wi.z < 0)) return Color(0);
    return color * (kInvPi * (1 - std::max(layer.kept(std::abs(wo.z)), layer.kept(std::abs(wi.z)))));
  }

  bool has_component(ScatterType letter) const { return letter == ScatterType::diffuse && !is_black(color); }
  Color eval_component(ScatterType letter, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return letter == ScatterType::diffuse ? eval(wo, wi, mode) : Color(0);
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
