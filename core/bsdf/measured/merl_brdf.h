// A measured material of the MERL database (`.binary`).                                       [Matusik et al. 2003]
//
// The file has three 32 bit sizes and, for red, green and blue, as many doubles as their product, all little-endian.
// Entries are ordered by theta_h, theta_d and phi_d, the angle of the half vector, the angle of the difference vector
// and its azimuth [Rusinkiewicz 1998]. theta_h is divided evenly in its square root, phi_d covers 180 degrees and
// varies fastest. Values are scaled by 1 / 1500, 1.15 / 1500 and 1.66 / 1500. Negative values mark missing measurements
// and count as 0. Values are interpolated between the midpoints of cells. Reciprocal, because phi_d covers 180 degrees
// only.
#pragma once
#include <filesystem>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "spectrum/rgb.h"

namespace etendue {

class MerlBrdf {
 public:
  // Input errors name the file and what is wrong with it.
  static Result<MerlBrdf> read(const std::filesystem::path& path);

  // 1/sr; both directions above the surface.
  Rgb f(const Vec3& o, const Vec3& i) const;

 private:
  int theta_h_count_ = 0, theta_d_count_ = 0, phi_d_count_ = 0;
  std::vector<Rgb> values_;
};

}  // namespace etendue
