// A ball under an even sky, and discs of photons as large as it is.                                    digest 8-10: F11
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void photons_on_a_ball(Lab& lab) {
  scene::Scene scene = sky();
  scene::add(scene, scene::sphere(1, 48, false), scene::diffuse(Rgb(0.5f)));
  auto d = lab.document(std::move(scene), telescope({0.3f, 0.2f, 6}, {0, 0, 1}));
  d.width = d.height = 4;
  // The scene's size is the diagonal of the cube around.
  for (const double radius : {0.5, 1.0, 1.5, 2.0}) {
    const std::string method =
        "photonmap:mode=direct:photons=20000:nearest=100000:renew=true:radius=" + number(radius / std::sqrt(12.0));
    // A cap of chord r has the area pi r^2; photons that face more than 60 degrees away, where r is one, are left out.
    // The part (1 - cos) / 2 of what falls onto a slope comes from below the plane of the middle.
    const double chord = std::min(radius, 1.0), mean_cosine = 1 - sqr(chord) / 4;
    lab.expect_near("photonmap:mode=direct", "disc of radius " + number(radius),
                    lab.mean(Lab::with_method(d, method), 12).value / 0.5, (1 + mean_cosine) / 2 * sqr(chord / radius),
                    0.06);
  }
}

inline constexpr Case kPhotonsOnABall{
    "photons-on-a-ball", Kind::bias,
    "Light is gathered from around the curve: a sphere has as much area within a distance as a plane, but part of what "
    "falls on it comes from below the plane; discs larger than it miss light as one over their squared radius",
    photons_on_a_ball};

}  // namespace etendue::stress
