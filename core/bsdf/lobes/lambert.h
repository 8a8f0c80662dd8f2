// Ideal diffuse reflection.                                                        [Lang, eq. 4.108, 4.217-4.219]
//
//   f = albedo / pi
//
// Reciprocal. Conserves energy for albedo <= 1. Sampled by the cosine: the weight of every sample is the albedo.
#pragma once
#include "base/warp.h"
#include "bsdf/lobe.h"

namespace etendue {

template <class Color>
struct Lambert {
  Color albedo{0};

  bool is_delta() const { return false; }
  float sampling_weight(const Vec3&) const { return average(albedo); }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode) const {
    return wo.z * wi.z > 0 ? albedo * kInvPi : Color(0);
  }

  bool has_component(ScatterType type) const { return type == ScatterType::diffuse && !is_black(albedo); }
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return type == ScatterType::diffuse ? eval(wo, wi, mode) : Color(0);
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode) const {
    return wo.z * wi.z > 0 ? cosine_hemisphere_pdf(std::abs(wi.z)) : 0;
  }

  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode, LobeSample<Color>& s) const {
    s.wi = random.cosine_direction;
    s.pdf_solid_angle = cosine_hemisphere_pdf(s.wi.z);
    if (wo.z < 0) s.wi.z = -s.wi.z;
    s.weight = albedo;
    s.type = ScatterType::diffuse;
    return s.pdf_solid_angle > 0;
  }

  void add_deltas(const Vec3&, TransportMode, DeltaSet<Color>&) const {}
};

}  // namespace etendue
