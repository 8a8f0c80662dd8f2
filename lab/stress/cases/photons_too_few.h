// No photons, and fewer than a lookup requests.   [Jensen 2001]
#pragma once
#include "stress/case.h"
#include "stress/lit_plate.h"

namespace etendue::stress {

inline void photons_too_few(TestContext& test) {
  auto d = test.document(lit_plate(), look_at({0, 8, 0}, {0, 0, 0}, {0, 0, 1}, 0.2f));
  d.width = d.height = 8;
  const auto mean = [&](const std::string& method) {
    return test.mean(TestContext::with_method(d, method), 4).value / kRadianceOfLitPlate;
  };
  test.expect_zero("photonmap:mode=direct:photons=0", "", mean("photonmap:mode=direct:photons=0"));
  test.expect_near("photonmap:photons=0", "direct light without photons", mean("photonmap:photons=0:caustic-photons=0"),
                   1, 1e-3);
  for (const char* few : {"photonmap:mode=direct:photons=1", "photonmap:mode=direct:photons=9:radius=0",
                          "sppm:connect=false:photons=1", "igi:light-paths=1", "igi:light-paths=1:interleave=16"})
    test.expect_between(few, "finite", mean(few), 0, 1e6);
}

inline constexpr Case kPhotonsTooFew{
    .name = "photons-too-few",
    .kind = Kind::parameters,
    .theory =
        "Lookups without photons yield zero, and lookups of more photons than exist use all of them "
        "without dividing by zero",
    .run = photons_too_few};

}  // namespace etendue::stress
