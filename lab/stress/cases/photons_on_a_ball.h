// A sphere under a uniform sky, and photon lookups as large as the sphere.   [Jensen 2001; Lang, sec. 9.5.3]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void photons_on_a_ball(TestContext& test) {
  scene::Scene scene = uniform_sky();
  scene::add(scene, scene::sphere(1, 48, false), scene::diffuse(Rgb(0.5f)));
  auto d = test.document(std::move(scene), narrow_camera({0.3f, 0.2f, 6}, {0, 0, 1}));
  d.width = d.height = 4;
  // The lookup radius is given relative to the diagonal of the bounding cube.
  for (const double radius : {0.5, 1.0, 1.5, 2.0}) {
    const std::string method =
        "photonmap:mode=direct:photons=20000:nearest=100000:renew=true:radius=" + number(radius / std::sqrt(12.0));
    // A cap with chord r has the area pi r^2. Photons whose normals differ by more than 60 degrees, beyond a chord of
    // one, are rejected. Of the light on an inclined surface the part (1 - cos) / 2 comes from below the tangent plane.
    const double chord = std::min(radius, 1.0), mean_cosine = 1 - sqr(chord) / 4;
    test.expect_near("photonmap:mode=direct", "disc of radius " + number(radius),
                     test.mean(TestContext::with_method(d, method), 12).value / 0.5,
                     (1 + mean_cosine) / 2 * sqr(chord / radius), 0.06);
  }
}

inline constexpr Case kPhotonsOnABall{
    .name = "photons-on-a-ball",
    .kind = Kind::bias,
    .theory =
        "A sphere has as much area within a chord length as a plane, but part of its light comes from "
        "below the tangent plane. Larger lookup discs miss light in proportion to 1 / radius^2",
    .run = photons_on_a_ball};

}  // namespace etendue::stress
