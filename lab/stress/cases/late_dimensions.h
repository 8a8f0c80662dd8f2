// How often the first 64 samples of a pixel clump in the first pair of dimensions and in a later one.
//    [Lang, sec. 7.2; Joe and Kuo 2008]
#pragma once
#include "stress/case.h"
#include "stress/statistics.h"

namespace etendue::stress {

inline void late_dimensions(TestContext& test) {
  const std::string half = ": pixels with half of 64 cells empty after 64 samples";
  // 64 independent points leave 23.4 +- 2.5 of the 64 cells empty.
  for (const char* sampler : {"random", "stratified", "halton", "sobol"})
    test.expect_between(sampler, "dimensions 0 and 1" + half, clumped_pixel_fraction(sampler, 0), 0, 0.004);
  test.expect_between("random", "dimensions 60 and 61" + half, clumped_pixel_fraction("random", 60), 0, 0.004);
  test.expect_between("halton", "dimensions 60 and 61" + half, clumped_pixel_fraction("halton", 60), 0.02, 1);
  test.expect_between("sobol", "dimensions 60 and 61" + half, clumped_pixel_fraction("sobol", 60), 0.5, 1);
  test.expect_between("pmj02", "dimensions 58 and 59" + half, clumped_pixel_fraction("pmj02", 58), 0, 0);
}

inline constexpr Case kLateDimensions{
    .name = "late-dimensions",
    .kind = Kind::correlation,
    .theory =
        "Low-discrepancy points cover the first pairs of dimensions evenly, but later pairs only with "
        "many samples. Halton points lie on lines below the prime base. Pairs of Sobol' matrices with a "
        "large t leave half of the square empty. A sequence of its own for each decision (pmj02) covers late pairs "
        "as evenly as early ones",
    .run = late_dimensions};

}  // namespace etendue::stress
