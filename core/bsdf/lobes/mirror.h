// Specular reflection: a single delta.                                    [Lang, eq. 4.91-4.94, 4.102-4.104, corrected]
//
//   f = tint F(cos_i) delta(wi - r) / cos_i,       r the mirror direction of wo about the shading normal
//
// Reciprocal. The albedo is tint F.
#pragma once
#include "bsdf/fresnel/fresnel_term.h"
#include "bsdf/lobes/delta_lobe.h"

namespace etendue {

// Fresnel is a function object that returns the reflectance for a cosine, as FresnelTerm does.
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
