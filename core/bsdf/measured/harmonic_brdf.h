// An isotropic BRDF in spherical harmonics.                                                   [Lang, eq. 4.202-4.205]
//
//   f(o, i) ~ sum over m, l, l' of c(m, l, l') p(l, m, cos_o) p(l', m, cos_i) cos(m dphi),     l, l' < bands
//
// p are normalised associated Legendre functions. This is <C(o), Y(i)> with C expanded in harmonics as well, so that a
// reciprocal function stays reciprocal. Both directions are continued below the horizon as mirror images: a diffuse
// surface is then constant and needs one band. The function must be isotropic and symmetric under reflection. With too
// few bands the sum rings and is negative in places; negative values are clamped, and the clamped part is reported.
#pragma once
#include <functional>
#include <vector>

#include "base/vec.h"
#include "spectrum/rgb.h"

namespace etendue {

class HarmonicBrdf {
 public:
  static constexpr int kMaxBands = 24;

  HarmonicBrdf() = default;
  // Projects f on `bands` bands, from 1 to kMaxBands. The mean of f(o, i) and f(i, o) is used.
  HarmonicBrdf(const std::function<Rgb(const Vec3&, const Vec3&)>& f, int bands);

  // Both directions above the surface; not negative.
  Rgb f(const Vec3& o, const Vec3& i) const;
  // The same before clamping.
  Rgb sum(const Vec3& o, const Vec3& i) const;
  // The clamped part over the remaining part, both averaged over all pairs of directions with cosine weights.
  float clamped_part() const { return clamped_part_; }

 private:
  int bands_ = 1;
  std::vector<Rgb> coefficients_;  // by m, l, l'; only even l + m and l' + m
  float clamped_part_ = 0;
};

}  // namespace etendue
