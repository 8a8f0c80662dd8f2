// A reflectance function in spherical harmonics.                                          thesis (4.150), item 46
//
//   f(o, i) ~ sum over m, l, l' of c(m, l, l') p(l, m, cos_o) p(l', m, cos_i) cos(m dphi),     l, l' < bands
//
// with p the Legendre functions normalised to one. That is <C(o), Y(i)> with C itself in harmonics, so that what is
// reciprocal stays so. Both directions are continued below the horizon as mirrored there: a diffuse surface is then a
// constant, and one band is enough for it. Isotropic functions that do not tell left from right. Where few bands are
// not enough the sum rings, and is negative in places: that is cut off, and how much it was is known.
#pragma once
#include <functional>
#include <vector>

#include "base/vec.h"
#include "spectrum/rgb.h"

namespace etendue {

class HarmonicBrdf {
 public:
  static constexpr int kMostBands = 24;

  HarmonicBrdf() = default;
  HarmonicBrdf(const std::function<Rgb(const Vec3&, const Vec3&)>& f, int bands);

  Rgb f(const Vec3& o, const Vec3& i) const;
  // Before anything was cut off.
  Rgb sum(const Vec3& o, const Vec3& i) const;
  // What was cut off, over what is left: both averaged over all pairs of directions, weighted by their cosines.
  float clamped() const { return clamped_; }

 private:
  int bands_ = 1;
  std::vector<Rgb> coefficients_;  // by m, l, l' where l + m and l' + m are even
  float clamped_ = 0;
};

}  // namespace etendue
