// What the specular layer of glTF's surface reflects, by the cosine to its facets.          glTF 2.0, appendix B.3.4
//
//   F = f0 + (f90 - f0) (1 - cos)^5
//
// The layer may be a mix of a dielectric and a metal; a base below it gets what the dielectric's part leaves.
#pragma once
#include "bsdf/fresnel/fresnel.h"

namespace etendue {

template <class Color>
struct SchlickFresnel {
  Color f0{0}, f90{0};                          // of the mix
  float dielectric_f0 = 0, dielectric_f90 = 0;  // the most that the dielectric reflects of any colour

  Color fresnel(float cosine) const { return f0 + (f90 - f0) * schlick_weight(cosine); }
  float kept(float cosine) const { return dielectric_f0 + (dielectric_f90 - dielectric_f0) * schlick_weight(cosine); }
  bool reflects() const { return !is_black(f90); }
};

}  // namespace etendue
