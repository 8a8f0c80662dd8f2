// No photon at all, and fewer than are asked for.                                                      digest 8-10: F27
#pragma once
#include "stress/case.h"
#include "stress/lit_plate.h"

namespace etendue::stress {

inline void photons_too_few(Lab& lab) {
  auto d = lab.document(lit_plate(), look_at({0, 8, 0}, {0, 0, 0}, {0, 0, 1}, 0.2f));
  d.width = d.height = 8;
  const auto mean = [&](const std::string& method) {
    return lab.mean(Lab::with_method(d, method), 4).value / kRadianceOfLitPlate;
  };
  lab.expect_zero("photonmap:mode=direct:photons=0", "", mean("photonmap:mode=direct:photons=0"));
  lab.expect_near("photonmap:photons=0", "shadow rays need none", mean("photonmap:photons=0:caustic-photons=0"), 1,
                  1e-3);
  for (const char* few : {"photonmap:mode=direct:photons=1", "photonmap:mode=direct:photons=9:radius=0",
                          "sppm:connect=false:photons=1", "igi:light-paths=1", "igi:light-paths=1:interleave=16"})
    lab.expect_between(few, "finite", mean(few), 0, 1e6);
}

inline constexpr Case kPhotonsTooFew{"photons-too-few", Kind::parameters,
                                     "Without photons it is dark where they are looked up, and fewer than an estimate "
                                     "takes are all of them: never is anything divided by nothing",
                                     photons_too_few};

}  // namespace etendue::stress
