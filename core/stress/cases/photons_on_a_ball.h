// A ball under an even sky, and discs of photons as large as it is.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void photons_on_a_ball(Lab& lab) {
  scene::Scene scene = sky();
  scene::add(scene, scene::sphere(1, 48, false), scene::diffuse(Rgb(0.5f)));
  auto d = lab.document(std::move(scene), telescope({0.3f, 0.2f, 6}, {0, 0, 1}));
  d.width = d.height = 4;
  struct Disc {
    double radius, share;
  };
  // The scene's size is the diagonal of the cube around.
  for (const auto& [radius, share] : {Disc{0.5, 1}, Disc{1, 1}, Disc{1.5, 1 / sqr(1.5)}, Disc{2, 0.25}}) {
    const std::string method =
        "photonmap:mode=direct:photons=20000:nearest=100000:renew=true:radius=" + number(radius / std::sqrt(12.0));
    lab.expect_near("photonmap:mode=direct", "disc of radius " + number(radius),
                    lab.mean(Lab::with_method(d, method), 16).value / 0.5, share, 0.06);
  }
}

inline constexpr Case kPhotonsOnABall{
    "photons-on-a-ball", Kind::bias,
    "A sphere has as much area within a distance as a plane, so that even discs as large as it are right; beyond, the "
    "photons that face elsewhere are left out and light is missing as one over the squared radius",
    photons_on_a_ball};

}  // namespace etendue::stress
