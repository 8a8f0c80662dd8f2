// A measured material of the RGL database.                                                    [Dupuy and Jakob 2018]
//
//   f cos_i = spectrum(s) D(h) / (4 sigma(o)),       s: the point of the unit square that visible normals map to h
//
// D and sigma are the distribution and the projected area of microfacets that a first pass of the measurement
// estimated. The spectrum is what remains, measured on a grid in s where it is smooth. Normals are sampled by the
// luminance of the spectrum and then by the microfacets visible from o: the density is the product of both. Isotropic
// RGB measurements. Not exactly reciprocal: o, for which directions are sampled, is the direction of the light in the
// measurement, i that of the sensor.
#pragma once
#include <filesystem>

#include "base/result.h"
#include "bsdf/lobe.h"
#include "bsdf/measured/bilinear_density.h"
#include "spectrum/rgb.h"

namespace etendue {

class RglBrdf {
 public:
  // Input errors name the file and what is wrong with it.
  static Result<RglBrdf> read(const std::filesystem::path& path);

  // As OpaqueLobe requires (lobes/opaque_lobe.h).
  Rgb f(const Vec3& o, const Vec3& i) const;
  float density(const Vec3& o, const Vec3& i) const;
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const;
  // A constant estimate for lobe selection.
  float albedo(const Vec3&) const { return 0.5f; }
  float alpha() const { return alpha_; }

 private:
  struct Pair;

  SliceBlend blend_at(float theta) const;
  Vec2 normal_at(const Vec3& h, float phi_o) const;
  void estimate_alpha();

  std::vector<float> thetas_;  // polar angles of o, ascending
  BilinearGrid ndf_, sigma_, rgb_;
  BilinearDensity visible_, luminance_;
  float alpha_ = 1;
};

}  // namespace etendue
