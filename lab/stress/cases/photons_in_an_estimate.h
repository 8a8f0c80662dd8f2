// One map, and more or fewer of its photons taken at a time.                                      digest 8-10: F12, O18
#pragma once
#include "stress/case.h"
#include "stress/lit_plate.h"

namespace etendue::stress {

inline void photons_in_an_estimate(Lab& lab) {
  // Pixels lie farther apart than discs are wide.
  auto d = lab.document(lit_plate(), look_at({0, 8, 0}, {0, 0, 0}, {0, 0, 1}, 0.2f));
  d.width = d.height = 16;
  d.filter = film::FilterKind::box;
  for (const int nearest : {6, 18, 52}) {
    const std::string method = "photonmap:mode=direct:photons=200000:nearest=" + std::to_string(nearest);
    const film::Mean mean = lab.mean(Lab::with_method(d, method), 1);
    const std::string point = std::to_string(nearest) + " photons, ";
    lab.expect_near("photonmap:mode=direct", point + "mean", mean.value / kRadianceOfLitPlate, 1, 0.15);
    lab.expect_near("photonmap:mode=direct", point + "variance / mean^2", mean.variance / sqr(mean.value),
                    1 / (nearest - 2.0), nearest < 10 ? 0.6 : 0.35);
  }
  // All there are: the disc goes through the corners, and more than a third of it is empty.
  auto middle = lab.document(lit_plate(), telescope({0, 2, 0.5f}, {0, 0, 0}));
  middle.width = middle.height = 4;
  const std::string all = "photonmap:mode=direct:photons=5000:nearest=100000:radius=0";
  lab.expect_near("photonmap:mode=direct", "all photons",
                  lab.mean(Lab::with_method(middle, all), 2).value / kRadianceOfLitPlate, 2 / double{kPi}, 0.06);
}

inline constexpr Case kPhotonsInAnEstimate{
    "photons-in-an-estimate", Kind::parameters,
    "The variance of an estimate from k photons is 1 / (k - 2); from all of them it is the mean of everything around",
    photons_in_an_estimate};

}  // namespace etendue::stress
