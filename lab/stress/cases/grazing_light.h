// A lamp that sinks towards the plane of the floor, and one that lies in it.                           digest 8-10: F26
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void grazing_light(Lab& lab) {
  constexpr float kDistance = 10, kAlbedo = 0.5f;
  const Camera camera = telescope({0, 3, 1}, {0, 0, 0});
  for (const float height : {1e-1f, 1e-2f, 1e-3f, 0.0f}) {
    scene::Scene scene;
    scene::add(scene, scene::quad(1), scene::diffuse(Rgb(kAlbedo)));
    // Wholly above the horizon and upright: an irradiance of pi / (1 + height^2)^2. In the plane it lies flat and faces
    // up, as the floor does.
    const float radius = height > 0 ? 0.1f * kDistance * height : 0.1f;
    Material lamp = scene::diffuse(Rgb(0), Rgb(height > 0 ? sqr(kDistance / radius) / height : 1e6f));
    lamp.double_sided = false;
    Mat4 place(1);  // its front towards -x
    if (height > 0) place[0] = Vec4(0, 1, 0, 0), place[1] = Vec4(-1, 0, 0, 0);
    place[3] = Vec4(kDistance, height * kDistance, 0, 1);
    scene::add(scene, scene::disk(radius, 48), lamp, place);
    const auto d = lab.document(std::move(scene), camera);
    const std::string point = "height over distance " + number(height);
    const double found = lab.mean(Lab::with_method(d, "path"), 64).value;
    if (height > 0)
      lab.expect_near("path", point, found, kAlbedo / sqr(1 + sqr(height)), 1e-3);
    else
      lab.expect_zero("path", point, found);
  }
}

inline constexpr Case kGrazingLight{
    "grazing-light", Kind::geometry,
    "Light at a grazing angle counts with the sine of its elevation down to the horizon, and not at all in the plane "
    "itself",
    grazing_light};

}  // namespace etendue::stress
