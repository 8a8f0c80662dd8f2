// Lookups of different numbers of photons in the same map.   [Jensen 2001; Lang, sec. 9.5.2]
#pragma once
#include "stress/case.h"
#include "stress/lit_plate.h"

namespace etendue::stress {

inline void photons_in_an_estimate(TestContext& test) {
  // The distance of the pixels exceeds the diameter of the lookup discs, so their estimates are independent.
  auto d = test.document(lit_plate(), look_at({0, 8, 0}, {0, 0, 0}, {0, 0, 1}, 0.2f));
  d.width = d.height = 16;
  d.filter = film::FilterKind::box;
  for (const int nearest : {6, 18, 52}) {
    const std::string method = "photonmap:mode=direct:photons=200000:nearest=" + std::to_string(nearest);
    const film::Mean mean = test.mean(TestContext::with_method(d, method), 1);
    const std::string point = std::to_string(nearest) + " photons, ";
    test.expect_near("photonmap:mode=direct", point + "mean", mean.value / kRadianceOfLitPlate, 1, 0.15);
    test.expect_near("photonmap:mode=direct", point + "variance / mean^2", mean.variance / sqr(mean.value),
                     1 / (nearest - 2.0), nearest < 10 ? 0.6 : 0.35);
  }
  // All photons: the disc passes through the corners, and 1 - 2 / pi of it lies beside the plate.
  auto middle = test.document(lit_plate(), narrow_camera({0, 2, 0.5f}, {0, 0, 0}));
  middle.width = middle.height = 4;
  const std::string all = "photonmap:mode=direct:photons=5000:nearest=100000:radius=0";
  test.expect_near("photonmap:mode=direct", "all photons",
                   test.mean(TestContext::with_method(middle, all), 2).value / kRadianceOfLitPlate, 2 / double{kPi},
                   0.06);
}

inline constexpr Case kPhotonsInAnEstimate{
    .name = "photons-in-an-estimate",
    .kind = Kind::parameters,
    .theory =
        "The relative variance of an estimate from k photons is 1 / (k - 2); an estimate from all "
        "photons is an average over the whole surface",
    .run = photons_in_an_estimate};

}  // namespace etendue::stress
