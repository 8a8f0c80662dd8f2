// The three axioms of a plausible surface, measured: it is not negative, light may go either way, and none is made.
//                                                                                 thesis (4.148)-(4.152), item 40
#pragma once
#include "bsdf_analysis/albedo.h"

namespace etendue::bsdf_analysis {

// Two directions and what f is for light from the second to the first.
struct Pair {
  Vec3 wo{0}, wi{0};
  double forth = 0, back = 0;
};

struct Plausibility {
  size_t pairs = 0;       // looked at
  size_t not_finite = 0;  // where f is no number, or infinite
  double least = 0;       // the lowest value of f; 0 if none is below
  Vec3 least_wo{0}, least_wi{0};
  double asymmetry = 0;  // the largest |f(a, b) - f(b, a)| over the larger of both, by the eta^2 law across a boundary
  Pair worst;            // where
  Albedo most;           // the largest of the curve
  double share_over_one = 0;  // of the angles looked at

  // f is symmetric but for rounding, which squared slopes of narrow lobes magnify.
  static constexpr double kAsymmetry = 1e-4;
  static constexpr double kExcess = 1e-4;

  bool non_negative() const { return not_finite == 0 && least >= 0; }
  bool reciprocal() const { return asymmetry <= kAsymmetry; }
  // Beyond doubt not if the excess is more than three standard errors.
  bool conserves_energy() const {
    return static_cast<double>(max_component(most.value)) <= 1 + kExcess + 3 * most.error;
  }
};

// `curve` holds the albedo under all angles, from outside and, where light passes, from inside.
Plausibility plausibility(const Lobes& lobes, const std::vector<Albedo>& curve, const Wanted& wanted = {});

}  // namespace etendue::bsdf_analysis
