// Photon lookups at the edge and at the corner of a plate.   [Jensen 2001; Lang, sec. 9.5.3]
#pragma once
#include "stress/case.h"
#include "stress/lit_plate.h"

namespace etendue::stress {

inline void photons_at_an_edge(TestContext& test) {
  struct Location {
    const char* name;
    Vec3 point;
    double share;  // of the lookup disc that lies on the plate
  };
  for (const Location& location : {Location{"middle", {0, 0, 0}, 1.0}, Location{"edge", {0.999f, 0, 0}, 0.5},
                                   Location{"corner", {0.999f, 0, 0.999f}, 0.25}}) {
    auto d = test.document(lit_plate(), narrow_camera(location.point + Vec3(0, 2, 0.5f), location.point));
    d.width = d.height = 4;
    const std::string map = "photonmap:photons=20000:nearest=200:radius=0:renew=true";
    test.expect_near("photonmap:mode=direct", location.name,
                     test.mean(TestContext::with_method(d, map + ":mode=direct"), 16).value / kRadianceOfLitPlate,
                     location.share, 0.09);
    test.expect_near("photonmap", location.name,
                     test.mean(TestContext::with_method(d, map), 2).value / kRadianceOfLitPlate, 1, 1e-3);
  }
}

inline constexpr Case kPhotonsAtAnEdge{
    .name = "photons-at-an-edge",
    .kind = Kind::bias,
    .theory =
        "A photon lookup divides by the area of its full disc. At an edge half of the disc lies beside "
        "the surface and half of the radiance is missing; at a corner three quarters. Final gathering "
        "does not look up photons there",
    .run = photons_at_an_edge};

}  // namespace etendue::stress
