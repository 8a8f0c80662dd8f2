// Directions drawn by a table of what a reflectance function is, for functions that have no formula.
//
// For a number of cosines (and azimuths, if it is not isotropic) of o, f is averaged over
// the cells of a grid that is even in the projected solid angle: its axes are the azimuth from o and cos_i^2. A
// direction is drawn from one of the grids next to o, by how near each is; a twentieth of all is spread evenly, so that
// nothing is out of reach. Its density times f cos is then about the albedo.
#pragma once
#include <functional>
#include <vector>

#include "base/piecewise_constant.h"
#include "bsdf/lobe.h"
#include "spectrum/rgb.h"

namespace etendue {

class DirectionTable {
 public:
  DirectionTable() = default;
  // `azimuths` is 1 for an isotropic function. A coarse table has half the rows and columns.
  DirectionTable(const std::function<Rgb(const Vec3&, const Vec3&)>& f, int azimuths, bool coarse);

  float density(const Vec3& o, const Vec3& i) const;
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const;
  float albedo(const Vec3& o) const;
  // Of facets whose lobe is about as wide, upright.
  float alpha() const { return alpha_; }

 private:
  static constexpr int kCosines = 24;  // grids

  // The grids next to o, with weights that add to one.
  struct Near {
    size_t grids[4];
    float weights[4];
  };
  Near near(const Vec3& o) const;

  int azimuths_ = 1;
  int columns_ = 96, rows_ = 64;  // of a grid
  std::vector<Piecewise2D> grids_;
  std::vector<float> albedos_;
  float alpha_ = 1;
};

}  // namespace etendue
