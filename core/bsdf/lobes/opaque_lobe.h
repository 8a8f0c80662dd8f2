// What the lobes of opaque models have in common, so that a model's own file holds its formulas and nothing else.
//
// A lobe derives from OpaqueLobe<Color, Itself> and offers, for directions above the surface (z > 0),
//
//   Color f(o, i) const;                    // for light that comes from i and leaves to o
//   float density(o, i) const;              // with which `draw` finds i, per solid angle
//   bool  draw(o, LobeRandom, Vec3& i) const; // false, or an i below the surface: absorbed
//   float weight(wo) const;                 // about its albedo
//   float alpha() const;                    // how wide it is, as the slope of facets
//
// and becomes a lobe with two equal sides. A model that is not reciprocal is told apart by the order of its arguments:
// importance that comes from wo stands for light that leaves to wo.
#pragma once
#include "bsdf/lobe.h"

namespace etendue {

template <class ColorType, class Lobe, ScatterType letter = ScatterType::glossy>
struct OpaqueLobe {
  using Color = ColorType;

  bool is_delta() const { return false; }

  Color eval(Vec3 wo, Vec3 wi, TransportMode mode) const {
    if (!raise(wo, wi)) return Color(0);
    return mode == TransportMode::radiance ? self().f(wo, wi) : self().f(wi, wo);
  }

  float pdf(Vec3 wo, Vec3 wi, TransportMode) const { return raise(wo, wi) ? self().density(wo, wi) : 0; }

  bool sample(const Vec3& wo_any, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const float side = wo_any.z < 0 ? -1.0f : 1.0f;
    const Vec3 wo(wo_any.x, wo_any.y, wo_any.z * side);
    if (!self().sample_direction(wo, random, s.wi) || !(s.wi.z > 0)) return false;
    s.type = letter;
    s.pdf_solid_angle = self().density(wo, s.wi);
    if (!(s.pdf_solid_angle > 0)) return false;
    s.weight = eval(wo, s.wi, mode) * (s.wi.z / s.pdf_solid_angle);
    s.wi.z *= side;
    return true;
  }

  bool has_component(ScatterType part) const { return part == letter; }
  Color eval_component(ScatterType part, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return part == letter ? eval(wo, wi, mode) : Color(0);
  }
  void add_deltas(const Vec3&, TransportMode, DeltaSet<Color>&) const {}

 private:
  const Lobe& self() const { return static_cast<const Lobe&>(*this); }
  // Turns both to the upper side; false if they are on different ones.
  static bool raise(Vec3& wo, Vec3& wi) {
    if (!(wo.z * wi.z > 0)) return false;
    if (wo.z < 0) wo.z = -wo.z, wi.z = -wi.z;
    return true;
  }
};

}  // namespace etendue
