// Densities on the unit square between values on a grid, several of them side by side and blended: what measured
// materials of Dupuy and Jakob (2018) are made of.
//
// Values are at the corners of patches, linear along both axes. Drawing picks the height by the marginal and the width
// by the conditional at this height, both inverted exactly; `invert` is the way back. A blend of two slices has their
// values and cumulative sums blended, so that it is a density again.
#pragma once
#include <span>
#include <vector>

#include "base/vec.h"

namespace etendue {

// Between two slices: the index of the first, and how far to the next.
struct SliceBlend {
  size_t first = 0;
  float t = 0;
};

// Values without cumulative sums.
class BilinearGrid {
 public:
  BilinearGrid() = default;
  // slices * height * width values, at least two each way.
  BilinearGrid(std::span<const float> values, size_t width, size_t height);

  float at(const Vec2& p, const SliceBlend& blend = {}, size_t slices_apart = 1) const;

 private:
  std::vector<float> values_;
  size_t width_ = 0, height_ = 0;
};

class BilinearDensity {
 public:
  struct Sample {
    Vec2 p;
    float pdf;
  };

  BilinearDensity() = default;
  // Each slice is made to have the integral one; one without anything is uniform.
  BilinearDensity(std::span<const float> values, size_t width, size_t height);

  Sample sample(const Vec2& u, const SliceBlend& blend) const;
  // What `sample` makes p of, and the density there.
  Sample invert(const Vec2& p, const SliceBlend& blend) const;

 private:
  struct View;

  std::vector<float> values_, row_sums_, marginal_;  // sums up to each node
  size_t width_ = 0, height_ = 0, slices_ = 0;
};

}  // namespace etendue
