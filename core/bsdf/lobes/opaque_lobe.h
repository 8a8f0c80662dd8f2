// The base of opaque lobes that reflect alike on both sides. It turns formulas for the upper side into a lobe.
//
// A lobe derives from OpaqueLobe<Color, Itself, type> and defines, for directions above the surface (z > 0),
//
//   Color f(o, i) const;              // f(i -> o): light comes from i and leaves to o; 1/sr, without the cosine
//   float density(o, i) const;        // density of `sample_direction` per solid angle of i
//   bool  sample_direction(o, random, Vec3& i) const;
//                                     // false, or an i below the surface: the sample is absorbed
//   float sampling_weight(wo) const;  // estimate of the directional albedo; wo on either side
//   float alpha() const;              // equivalent microfacet roughness, 1 for a diffuse lobe
//
// For models that are not reciprocal the order of the arguments of f matters: the adjoint is f(i, o).
#pragma once
#include "bsdf/lobe.h"

namespace etendue {

template <class ColorType, class Lobe, ScatterType scatter_type = ScatterType::glossy>
struct OpaqueLobe {
  using Color = ColorType;

  bool is_delta() const { return false; }

  Color eval(Vec3 wo, Vec3 wi, TransportMode mode) const {
    if (!to_upper_side(wo, wi)) return Color(0);
    return mode == TransportMode::radiance ? self().f(wo, wi) : self().f(wi, wo);
  }

  float pdf(Vec3 wo, Vec3 wi, TransportMode) const { return to_upper_side(wo, wi) ? self().density(wo, wi) : 0; }

  bool sample(const Vec3& wo_any, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const float side = wo_any.z < 0 ? -1.0f : 1.0f;
    const Vec3 wo(wo_any.x, wo_any.y, wo_any.z * side);
    if (!self().sample_direction(wo, random, s.wi) || !(s.wi.z > 0)) return false;
    s.type = scatter_type;
    s.pdf_solid_angle = self().density(wo, s.wi);
    if (!(s.pdf_solid_angle > 0)) return false;
    s.weight = eval(wo, s.wi, mode) * (s.wi.z / s.pdf_solid_angle);
    s.wi.z *= side;
    return true;
  }

  bool has_component(ScatterType type) const { return type == scatter_type; }
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return type == scatter_type ? eval(wo, wi, mode) : Color(0);
  }
  void add_deltas(const Vec3&, TransportMode, DeltaSet<Color>&) const {}

 private:
  const Lobe& self() const { return static_cast<const Lobe&>(*this); }
  // Mirrors both directions to the upper side; false if they are on opposite sides.
  static bool to_upper_side(Vec3& wo, Vec3& wi) {
    if (!(wo.z * wi.z > 0)) return false;
    if (wo.z < 0) {
      wo.z = -wo.z;
      wi.z = -wi.z;
    }
    return true;
  }
};

}  // namespace etendue
