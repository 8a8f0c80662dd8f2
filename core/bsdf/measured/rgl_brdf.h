// Measured materials of the RGL database.       Dupuy and Jakob, "An Adaptive Parameterization for Efficient Material
//                                               Acquisition and Rendering", 2018; thesis item 45
//
//   f cos_i = spectrum(s) D(h) / (4 sigma(o)),       s = the square's point that the visible normals of o turn into h
//
// D and sigma are the facets' distribution and projected area that were found in a first pass; what was measured is the
// rest, on a grid in s where it is smooth. Normals are drawn by the luminance of that rest and then by the facets that
// o sees: the density is that of the product. Isotropic measurements in RGB. Not exactly reciprocal: o, which
// directions are drawn for, is where the light was in the measurement; the values are what was seen.
#pragma once
#include <filesystem>

#include "base/result.h"
#include "bsdf/lobe.h"
#include "bsdf/measured/bilinear_density.h"
#include "spectrum/rgb.h"

namespace etendue {

class RglBrdf {
 public:
  static Result<RglBrdf> read(const std::filesystem::path& path);

  Rgb f(const Vec3& o, const Vec3& i) const;
  float density(const Vec3& o, const Vec3& i) const;
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const;
  float albedo(const Vec3&) const { return 0.5f; }
  float alpha() const { return alpha_; }

 private:
  struct Seen;

  SliceBlend blend_at(float theta) const;
  Vec2 normal_at(const Vec3& h, float phi_o) const;
  void estimate_alpha();

  std::vector<float> thetas_;  // of o, rising
  BilinearGrid ndf_, sigma_, rgb_;
  BilinearDensity visible_, luminance_;
  float alpha_ = 1;
};

}  // namespace etendue
