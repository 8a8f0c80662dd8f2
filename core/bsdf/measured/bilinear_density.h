// Bilinearly interpolated functions and densities on the unit square, in slices that can be blended: the data structure
// of measured materials of [Dupuy and Jakob 2018].
//
// Values are given at the nodes of a grid and are linear along both axes in between. Sampling inverts the marginal
// density in y and the conditional density in x exactly. A blend of two slices interpolates both their values and their
// cumulative sums, so that it is a density again.
#pragma once
#include <span>
#include <vector>

#include "base/vec.h"

namespace etendue {

// A linear interpolation between slices `first` (t = 0) and the following one (t = 1).
struct SliceBlend {
  size_t first = 0;
  float t = 0;
};

// Interpolated values, without sampling.
class BilinearGrid {
 public:
  BilinearGrid() = default;
  // slices * height * width values, x fastest; width and height at least 2.
  BilinearGrid(std::span<const float> values, size_t width, size_t height);

  // The value at p in [0, 1]^2. The second slice of the blend is `blend.first + slice_stride`.
  float at(const Vec2& p, const SliceBlend& blend = {}, size_t slice_stride = 1) const;

 private:
  std::vector<float> values_;
  size_t width_ = 0, height_ = 0;
};

// Interpolated densities with sampling.
class BilinearDensity {
 public:
  struct Sample {
    Vec2 p;
    float pdf;  // per unit area of the square
  };

  BilinearDensity() = default;
  // slices * height * width values, x fastest. Each slice is normalised to the integral 1; a slice of zeros is uniform.
  BilinearDensity(std::span<const float> values, size_t width, size_t height);

  // Maps a uniform u to a point with this density.
  Sample sample(const Vec2& u, const SliceBlend& blend) const;
  // The inverse of `sample`: the u (in `p`) that is mapped to p, and the density at p.
  Sample invert(const Vec2& p, const SliceBlend& blend) const;

 private:
  struct View;

  std::vector<float> values_, row_sums_, marginal_;  // cumulative along x and along y
  size_t width_ = 0, height_ = 0, slices_ = 0;
};

}  // namespace etendue
