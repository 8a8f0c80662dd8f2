// The normalised diffusion profile: how far from its entry light leaves a scattering body.
//                                                                                     [Christensen and Burley 2015]
//
//   R(r) = A (exp(-r / d) + exp(-r / (3 d))) / (8 pi d r),    2 pi (integral of R r dr) = A
//   d = l / (1.9 - A + 3.5 (A - 0.8)^2)
//
// r is the distance between entry and exit, l the mean free path inside, and A the diffuse reflectance. The profile is
// a fit to Monte Carlo simulations of a flat half-space.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace etendue {

class NormalizedDiffusion {
 public:
  // `mean_free_path` is l in metres, positive; `albedo` is A in [0, 1].
  NormalizedDiffusion(float mean_free_path, float albedo)
      : d_(mean_free_path / (1.9f - albedo + 3.5f * sqr(albedo - 0.8f))) {}

  // Beyond this radius lies a share of 2e-4 of the light, which is neglected.
  float largest_radius() const { return kLargest * d_; }

  // R / A, 1/m^2.
  float value(float r) const {
    const float x = std::max(r / d_, kSmallest);
    return (std::exp(-x) + std::exp(-x / 3)) / (8 * kPi * sqr(d_) * x);
  }
  // The radius within which a share `u` of the light leaves: 1 - exp(-r / d) / 4 - 3 exp(-r / (3 d)) / 4 is the
  // distribution, a mixture of two exponential ones.
  float sample_radius(float u) const {
    const float first = u < 0.25f ? 1 - 4 * u : 1 - (u - 0.25f) / 0.75f;
    return -(u < 0.25f ? 1 : 3) * d_ * std::log(std::max(first, 1e-12f));
  }

 private:
  static constexpr float kLargest = 25, kSmallest = 1e-6f;

  float d_;
};

}  // namespace etendue
