// Reconstruction filters, by importance sampling: a sample's place under the pixel is drawn from the filter itself,
// every sample weighs one and belongs to one pixel.                        thesis (8.47)-(8.54); Ernst et al. 2006
//
// All four filters are separable and positive, so that every sample weighs the same. Offsets are in pixels from the
// centre.
#pragma once
#include <array>

#include "base/distribution.h"
#include "base/parameter.h"
#include "base/vec.h"

namespace etendue::film {

enum class FilterKind { box, tent, gaussian, blackman_harris };

class Filter {
 public:
  explicit Filter(FilterKind kind = FilterKind::blackman_harris);

  FilterKind kind() const { return kind_; }
  // Half the width of the support in pixels.
  float radius() const;
  // The offset for a point of the unit square.
  Vec2 sample(Vec2 u) const { return Vec2(sample_1d(u.x), sample_1d(u.y)); }
  // The density of one coordinate of the offset; the filter's own value where that is normalised.
  float value(float x) const;

 private:
  float sample_1d(float u) const;
  FilterKind kind_;
  Piecewise1D table_;  // of the filters without an inverse in closed form, over their support
};

}  // namespace etendue::film

template <>
struct etendue::Options<etendue::film::FilterKind> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"box", "Box"}, {"tent", "Tent"}, {"gaussian", "Gaussian"}, {"blackman-harris", "Blackman-Harris"}}};
};
