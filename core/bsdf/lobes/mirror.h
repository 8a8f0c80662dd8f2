// A plane mirror: one delta.                                     thesis (4.116)-(4.123), items 33, 34, erratum E6
//
//   f = tint F(cos) delta(wi - mirrored wo) / cos
#pragma once
#include "bsdf/fresnel/fresnel_term.h"
#include "bsdf/lobes/delta_lobe.h"

namespace etendue {

// Fresnel: from the cosine to a reflectance by band.
template <class Color, class Fresnel = FresnelTerm<Color>>
struct Mirror : DeltaLobe<Color> {
  Color tint{1};
  Fresnel fresnel;

  float sampling_weight(const Vec3& wo) const { return average(reflected(wo)); }

  bool sample(const Vec3& wo, const LobeRandom&, TransportMode, LobeSample<Color>& s) const {
    s.wi = this->mirrored(wo);
    s.weight = reflected(wo);
    s.type = ScatterType::specular;
    s.delta = true;
    return true;
  }
  void add_deltas(const Vec3& wo, TransportMode, DeltaSet<Color>& deltas) const {
    deltas.add_reflection(this->mirrored(wo), reflected(wo), 1);
  }

 private:
  Color reflected(const Vec3& wo) const { return tint * fresnel(std::abs(wo.z)); }
};

}  // namespace etendue
