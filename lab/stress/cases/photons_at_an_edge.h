// A plate that ends where photons are looked up.                                                       digest 8-10: F10
#pragma once
#include "stress/case.h"
#include "stress/lit_plate.h"

namespace etendue::stress {

inline void photons_at_an_edge(Lab& lab) {
  struct Place {
    const char* name;
    Vec3 at;
    double share;  // of the disc that lies on the plate
  };
  for (const Place& place : {Place{"middle", {0, 0, 0}, 1.0}, Place{"edge", {0.999f, 0, 0}, 0.5},
                             Place{"corner", {0.999f, 0, 0.999f}, 0.25}}) {
    auto d = lab.document(lit_plate(), telescope(place.at + Vec3(0, 2, 0.5f), place.at));
    d.width = d.height = 4;
    const std::string map = "photonmap:photons=20000:nearest=200:radius=0:renew=true";
    lab.expect_near("photonmap:mode=direct", place.name,
                    lab.mean(Lab::with_method(d, map + ":mode=direct"), 16).value / kRadianceOfLitPlate, place.share,
                    0.09);
    lab.expect_near("photonmap", place.name, lab.mean(Lab::with_method(d, map), 2).value / kRadianceOfLitPlate, 1,
                    1e-3);
  }
}

inline constexpr Case kPhotonsAtAnEdge{
    "photons-at-an-edge", Kind::bias,
    "A lookup takes its disc for full: at an edge half of it lies beside the surface and half of the light is missing, "
    "at a corner three quarters; what does not look up there loses nothing",
    photons_at_an_edge};

}  // namespace etendue::stress
