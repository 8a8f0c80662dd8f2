// How often the first 64 samples of a pixel clump in an early and in a late pair of dimensions.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void late_dimensions(Lab& lab) {
  const std::string half = ": pixels with half of 64 cells empty after 64 samples";
  // Independent numbers leave 23.4 +- 2.5 cells empty.
  for (const char* sampler : {"random", "stratified", "halton", "sobol"})
    lab.expect_between(sampler, "dimensions 0 and 1" + half, clumped_pixels(sampler, 0), 0, 0.004);
  lab.expect_between("random", "dimensions 60 and 61" + half, clumped_pixels("random", 60), 0, 0.004);
  lab.expect_between("halton", "dimensions 60 and 61" + half, clumped_pixels("halton", 60), 0.02, 1);
  lab.expect_between("sobol", "dimensions 60 and 61" + half, clumped_pixels("sobol", 60), 0.5, 1);
}

inline constexpr Case kLateDimensions{"late-dimensions", Kind::correlation,
                                      "Low-discrepancy points fill early pairs of dimensions evenly, late ones not "
                                      "before there are many: Halton's lie on "
                                      "lines while samples are fewer than the prime, and pairs of Sobol' matrices of a "
                                      "large t leave half of the square empty",
                                      late_dimensions};

}  // namespace etendue::stress
