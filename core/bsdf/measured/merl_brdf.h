// Measured materials of the MERL database (`.binary`).                     Matusik, Pfister, Brand and McMillan, 2003
//
// Three 32 bit sizes, and for red, green and blue as many doubles as their product: by the angle of the half vector
// (its root is divided evenly), of the difference to it, and the azimuth of the difference over half a turn. Values are
// scaled by 1 / 1500, 1.15 / 1500 and 1.66 / 1500; negative ones mark what was not measured and count as 0. Between the
// middles of cells values are interpolated. Reciprocal, because half a turn is all there is.
#pragma once
#include <filesystem>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "spectrum/rgb.h"

namespace etendue {

class MerlBrdf {
 public:
  static Result<MerlBrdf> read(const std::filesystem::path& path);

  Rgb f(const Vec3& o, const Vec3& i) const;

 private:
  int halves_ = 0, differences_ = 0, azimuths_ = 0;
  std::vector<Rgb> values_;
};

}  // namespace etendue
