// Piecewise constant distributions: choosing one of many (a light by its power), a point on [0,1) or in [0,1)^2
// (an environment map by its luminance).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace etendue {

// Chooses an index with probability proportional to its weight in O(1): Vose's alias table, 1991.
class AliasTable {
 public:
  struct Choice {
    uint32_t index;
    float probability;  // pdf_discrete
  };

  AliasTable() = default;
  // Weights must be finite and not negative. If all are zero every index is equally likely.
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

// A density on [0,1) that is constant on n equal cells.
class Piecewise1D {
 public:
  struct Sample {
    float x, pdf;
    uint32_t cell;
  };

  Piecewise1D() = default;
  explicit Piecewise1D(std::span<const float> values);

  float integral() const { return integral_; }
  size_t size() const { return values_.size(); }
  Sample sample(float u) const;
  float pdf(float x) const;

 private:
  std::vector<float> values_, cdf_;
  std::vector<uint32_t> guide_;  // the cell where each of as many equal parts of the random number starts (Chen 1974)
  float integral_ = 0;
};

// A density on [0,1)^2 that is constant on cells: a marginal over rows, then a conditional along the row.
class Piecewise2D {
 public:
  struct Sample {
    Vec2 uv;
    float pdf;  // per unit of [0,1)^2
  };

  Piecewise2D() = default;
  // `values` holds height rows of width cells; v = 0 is the first row.
  Piecewise2D(std::span<const float> values, int width, int height);

  bool empty() const { return rows_.empty(); }
  float integral() const { return marginal_.integral(); }
  Sample sample(Vec2 u) const;
  float pdf(Vec2 uv) const;

 private:
  std::vector<Piecewise1D> rows_;
  Piecewise1D marginal_;
};

}  // namespace etendue
