// Pixel reconstruction filters, by importance sampling                    [Lang, eq. 8.47-8.54; Ernst et al. 2006]
//
// The position of a sample is drawn from the filter of its pixel. Each sample therefore has weight 1 and contributes to
// one pixel. All filters are separable and positive. Offsets are in pixels from the pixel centre.
//
// `centre` is no filter: all samples are at the pixel centre, as in the first ray tracers [Lang, sec. 8.2], which
// aliases for any number of samples.
//
// To add a filter, add an enumerator, its option and its kernel in filter.cpp.
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
  // Half the width of the support, in pixels.
  float radius() const { return radius(kind_); }
  // The offset for a uniform point of the unit square.
  Vec2 sample(Vec2 u) const { return Vec2(inverse(u.x), inverse(u.y)); }
  // Replaces `count` uniform numbers by one coordinate of the offset each. The array holds padded_lanes(count)
  // elements.
  void sample_all(float* u, size_t count) const;
  // The density of one coordinate of the offset, which is the normalised filter; 0 for `centre`.
  float value(float x) const { return value(kind_, x); }

  // For a position between two neighbouring pixel centres, at `t` in [0, 1]: the cumulative sums of the filter values
  // at the four nearest pixel centres, from left to right. Interpolated from a table, with an error of at most 1e-5.
  using Sums = std::array<float, 4>;
  Sums sums_around(float t) const {
    const float position = std::min(t * kSumCells, static_cast<float>(kSumCells));
    const auto i = static_cast<size_t>(std::min(position, kSumCells - 1.0f));
    const float part = position - static_cast<float>(i);
    Sums sums;
    for (size_t k = 0; k < sums.size(); ++k) sums[k] = sums_[i][k] + (sums_[i + 1][k] - sums_[i][k]) * part;
    return sums;
  }

 private:
  static float radius(FilterKind kind);
  static float value(FilterKind kind, float x);
  static constexpr int kPositionCells = 1024;

  // The inverse of the cumulative distribution. The table is indexed by q, where q^4 is the integral of the filter
  // beyond |x|: x is a smooth function of q up to the end of the tails, which a table over the integral would not
  // resolve.
  [[gnu::always_inline]] float inverse(float u) const {
    const float side = u - 0.5f;
    const float position = kPositionCells * std::sqrt(std::sqrt(1 - 2 * std::abs(side)));
    // The unused elements of the last register may be NaN; these are read as 0.
    const auto cell = static_cast<int>(std::max(0.0f, std::min(position, kPositionCells - 1.0f)));
    const auto i = static_cast<size_t>(cell);
    const float x = positions_[i] + (positions_[i + 1] - positions_[i]) * (position - static_cast<float>(cell));
    return std::copysign(x, side);
  }

  using PositionTable = std::array<float, kPositionCells + 1>;
  static PositionTable tabulate_positions(FilterKind kind);
  static constexpr int kSumCells = 512;
  using SumTable = std::array<Sums, kSumCells + 1>;
  static SumTable tabulate_sums(FilterKind kind);
  struct Tables;

  FilterKind kind_;
  // The tables of all kinds are computed once and shared.
  const float* positions_;
  const Sums* sums_;
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
