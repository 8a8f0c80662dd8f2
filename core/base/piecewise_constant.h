// Sampling of piecewise constant distributions
//
// Discrete (a light, by its power), over [0, 1) and over [0, 1)^2 (an environment map, by its luminance).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace etendue {

// Samples an index with probability proportional to its weight in constant time: alias method [Vose 1991].
class AliasTable {
 public:
  struct Choice {
    uint32_t index;
    float probability;
  };

  AliasTable() = default;
  // Weights must be finite and not negative. If all are zero, all indices are equally likely.
  explicit AliasTable(std::span<const float> weights);

  bool empty() const { return bins_.empty(); }
  size_t size() const { return bins_.size(); }
  Choice sample(float u) const {
    const float scaled = u * static_cast<float>(bins_.size());
    const auto bin = std::min(static_cast<uint32_t>(scaled), static_cast<uint32_t>(bins_.size() - 1));
    const float rest = scaled - static_cast<float>(bin);
    const uint32_t index = rest < bins_[bin].threshold ? bin : bins_[bin].alias;
    return {index, bins_[index].probability};
  }
  float probability(uint32_t index) const { return bins_[index].probability; }

 private:
  struct Bin {
    float threshold, probability;
    uint32_t alias;
  };
  std::vector<Bin> bins_;
};

// A density on [0, 1) that is constant on n cells of equal width.
class Piecewise1D {
 public:
  struct Sample {
    float x, pdf;
    uint32_t cell;
  };

  Piecewise1D() = default;
  // The density is proportional to `values`, which must be finite and not negative; if all are zero, it is uniform.
  explicit Piecewise1D(std::span<const float> values);

  // The mean of the values given, which is the integral of the function over [0, 1).
  float integral() const { return integral_; }
  size_t size() const { return values_.size(); }
  Sample sample(float u) const;
  // `sample` without the density.
  struct Point {
    float x;
    uint32_t cell;
  };
  Point find(float u) const;
  float pdf(float x) const;

 private:
  std::vector<float> values_, cdf_;
  // Guide table [Chen and Asau 1974]: entry i is the cell that contains the random number i / (guide_.size() - 1), so
  // that the search of a cell starts close to it.
  std::vector<uint32_t> guide_;
  float integral_ = 0;
};

// A density on [0, 1)^2 that is constant on the cells of a grid: marginal density of the row times the conditional
// density along the row.
class Piecewise2D {
 public:
  struct Sample {
    Vec2 uv;
    float pdf;  // per unit of [0,1)^2
  };

  Piecewise2D() = default;
  // `values` holds `height` rows of `width` cells; the first row is at v = 0.
  Piecewise2D(std::span<const float> values, int width, int height);

  bool empty() const { return rows_.empty(); }
  float integral() const { return marginal_.integral(); }
  Sample sample(Vec2 u) const;
  // `sample` without the density.
  Vec2 find(Vec2 u) const;
  float pdf(Vec2 uv) const;

 private:
  std::vector<Piecewise1D> rows_;
  Piecewise1D marginal_;
};

}  // namespace etendue
