// Physical plausibility of a BSDF, measured: non-negativity, reciprocity and conservation of energy.
//                                                               [Lang, sec. 4.2.2.3, eq. 4.134, 4.147 and Remark 4.10]
#pragma once
#include "bsdf_analysis/albedo.h"

namespace etendue::bsdf_analysis {

// Two directions and both sides of the reciprocity relation: f(wi -> wo), scaled by eta^2 across a boundary, and
// f(wo -> wi).
struct ReciprocityPair {
  Vec3 wo{0}, wi{0};
  double forward = 0, reverse = 0;
};

struct Plausibility {
  size_t pairs = 0;       // pairs of directions that were evaluated
  size_t not_finite = 0;  // pairs for which f is NaN or infinite
  double minimum = 0;     // the smallest value of f; 0 if none is negative
  Vec3 minimum_wo{0}, minimum_wi{0};
  double asymmetry = 0;       // the largest relative violation of reciprocity, |forward - reverse| / max of both
  ReciprocityPair worst;      // where it occurs
  Albedo largest_albedo;      // the largest value of the curve
  double share_over_one = 0;  // the fraction of the tested angles at which the albedo exceeds one

  // Tolerances for rounding errors, which the squared slopes of narrow lobes magnify.
  static constexpr double kAsymmetry = 1e-4;
  static constexpr double kExcess = 1e-4;

  bool non_negative() const { return not_finite == 0 && minimum >= 0; }
  bool reciprocal() const { return asymmetry <= kAsymmetry; }
  // False if the albedo exceeds one by more than three standard errors.
  bool conserves_energy() const {
    return static_cast<double>(max_component(largest_albedo.value)) <= 1 + kExcess + 3 * largest_albedo.error;
  }
};

// `curve` holds the albedo at all tested angles, from outside and, for transmissive surfaces, from inside.
Plausibility plausibility(const Lobes& lobes, const std::vector<Albedo>& curve, const KeepGoing& keep_going = {});

}  // namespace etendue::bsdf_analysis
