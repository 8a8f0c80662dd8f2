// The coefficients of the control variate of direct light, for tiles of an image.
#pragma once
#include <cstddef>
#include <vector>

#include "spectrum/rgb.h"

namespace etendue::integrator {

// Sums of estimates over the points that the pixels of a tile see.
struct ControlSums {
  Rgb difference{0};  // of the expectations of the two terms of B, that of light sampling less that of BSDF sampling
  Rgb albedo{0};      // a
  Rgb overlap{0};     // a times the integral of p_l p_b / (p_l + p_b)

  ControlSums& operator+=(const ControlSums& other);
};

// The coefficient for which B + c K has the least variance (direct_light_control.h):
//
//    Cov(B, K0) = -m (E[B_l] - E[B_b]),   Var(K0) = m (1 - 2 m),   m = integral of p_l p_b / (p_l + p_b)
//
// with K = a K0, and thus c = (E[B_l] - E[B_b]) / (a (1 - 2 m)). Unlike the quotient of an observed covariance and
// variance, it is not dominated by rare values of K.
Rgb control_coefficient(const ControlSums& sums);

class ControlCoefficients {
 public:
  static constexpr int kTile = 8;  // pixels

  ControlCoefficients(int width, int height);

  // Of the tile that contains this pixel. Different tiles may be written at the same time.
  ControlSums& sums(int x, int y) { return sums_[index(x, y)]; }
  // Computes the coefficients, one for each tile or one for all.
  void compute(bool one_for_all);
  const Rgb& at(int x, int y) const { return coefficients_[index(x, y)]; }
  size_t memory() const { return sums_.size() * sizeof(ControlSums) + coefficients_.size() * sizeof(Rgb); }

 private:
  size_t index(int x, int y) const { return static_cast<size_t>(y / kTile * columns_ + x / kTile); }

  int columns_;
  std::vector<ControlSums> sums_;
  std::vector<Rgb> coefficients_;
};

}  // namespace etendue::integrator
