// Reconstruction filters, by importance sampling: a sample's place under the pixel is drawn from the filter itself,
// every sample weighs one and belongs to one pixel.                        thesis (8.47)-(8.54); Ernst et al. 2006
//
// All are separable and positive, so that every sample weighs the same. Offsets are in pixels from the centre. One is
// no filter at all: the centre alone, as ray casting began (thesis 8.2), which aliases however many samples are taken.
#pragma once
#include <array>

#include "base/parameter.h"
#include "base/vec.h"

namespace etendue::film {

enum class FilterKind { box, tent, gaussian, blackman_harris, centre };

class Filter {
 public:
  explicit Filter(FilterKind kind = FilterKind::blackman_harris);

  FilterKind kind() const { return kind_; }
  // Half the width of the support in pixels.
  float radius() const { return radius_; }
  // The offset for a point of the unit square.
  Vec2 sample(Vec2 u) const { return Vec2(inverse(u.x), inverse(u.y)); }
  // One coordinate of it for many points, in place; the array has room for whole registers.
  void sample_all(float* u, size_t count) const;
  // The density of one coordinate of the offset; the filter's own value where that is normalised. The centre has none.
  float value(float x) const { return value(kind_, x); }
  // The same between -radius and radius, from a table: off by 1e-5 at most.
  float quick_value(float x) const {
    const float at = std::min(std::abs(x) * per_radius_, static_cast<float>(kTable));
    const auto i = static_cast<size_t>(std::min(at, kTable - 1.0f));
    return values_[i] + (values_[i + 1] - values_[i]) * (at - static_cast<float>(i));
  }

 private:
  static float radius(FilterKind kind);
  static float value(FilterKind kind, float x);
  static constexpr int kTable = 1024;

  // The filter's mass beyond |x| on both sides is q^4: its position is a smooth function of q up to the very end of the
  // tails, which a table of the mass itself would cut off.
  [[gnu::always_inline]] float inverse(float u) const {
    const float side = u - 0.5f;
    const float at = kTable * std::sqrt(std::sqrt(1 - 2 * std::abs(side)));
    // Clamped from below too: what stands beyond the last point of a whole register may be no number.
    const int cell = std::max(0, std::min(static_cast<int>(at), kTable - 1));
    const auto i = static_cast<size_t>(cell);
    const float x = positions_[i] + (positions_[i + 1] - positions_[i]) * (at - static_cast<float>(cell));
    return std::copysign(x, side);
  }

  using Table = std::array<float, kTable + 1>;
  static Table positions(FilterKind kind);
  static Table values(FilterKind kind);

  FilterKind kind_;
  float radius_, per_radius_;  // the second: table cells to a pixel
  // A table for each kind is made once: filters are made anew with every edit.
  const float* positions_;
  const float* values_;
};

}  // namespace etendue::film

template <>
struct etendue::Options<etendue::film::FilterKind> {
  static constexpr std::array<etendue::Option, 5> kOptions{{{"box", "Box"},
                                                            {"tent", "Tent"},
                                                            {"gaussian", "Gaussian"},
                                                            {"blackman-harris", "Blackman-Harris"},
                                                            {"centre", "Pixel centre"}}};
};
