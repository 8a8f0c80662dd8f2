// Tabulated importance sampling for BRDFs that are data.
//
// For 24 cosines of o (and several azimuths if f is anisotropic), f is averaged over the cells of a grid that is
// uniform in projected solid angle: its axes are the azimuth relative to o and cos_i^2. A direction is sampled from one
// of the grids next to o, selected by its interpolation weight. 5 % of the density is spread uniformly, so that every
// direction can be sampled. The density is then about f cos_i over the albedo.
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
  // f(o, i) for directions above the surface. `azimuths` is 1 for an isotropic f. A coarse table has half the rows and
  // columns.
  DirectionTable(const std::function<Rgb(const Vec3&, const Vec3&)>& f, int azimuths, bool coarse);

  // Density of `sample_direction` per solid angle of i.
  float density(const Vec3& o, const Vec3& i) const;
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const;
  // The directional albedo, averaged over the colours; o on either side.
  float albedo(const Vec3& o) const;
  // The roughness of microfacets with a lobe of about the same width, at normal incidence.
  float alpha() const { return alpha_; }

 private:
  static constexpr int kCosines = 24;  // grids per azimuth

  // The grids next to o, with interpolation weights that sum to 1.
  struct GridWeights {
    size_t grids[4];
    float weights[4];
  };
  GridWeights grids_near(const Vec3& o) const;

  int azimuths_ = 1;
  int columns_ = 96, rows_ = 64;  // of a grid
  std::vector<Piecewise2D> grids_;
  std::vector<float> albedos_;
  float alpha_ = 1;
};

}  // namespace etendue
