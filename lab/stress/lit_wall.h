// A unit wall under a directional light, and a small floor in front of it that is lit by the wall only.
#pragma once
#include "stress/test_context.h"

namespace etendue::stress {

// The wall lies at z = 0 with x from -1/2 to 1/2 and y from 0 to 1; its irradiance is one. The floor of albedo 1/2 lies
// at (0, 0, distance).
inline scene::Scene lit_wall(const Material& wall, float distance) {
  scene::Scene scene;
  Mat4 upright(1);
  upright[1] = Vec4(0, 0, 1, 0);
  upright[2] = Vec4(0, -1, 0, 0);
  upright[3] = Vec4(0, 0.5f, 0, 1);
  scene::add(scene, scene::quad(0.5f), wall, upright);
  Mat4 transform(1);
  transform[3] = Vec4(0, 0, distance, 1);
  scene::add(scene, scene::quad(0.02f * distance), scene::diffuse(Rgb(0.5f)), transform);
  scene::add(scene, make_light("directional"), {});
  return scene;
}

// A camera that sees one point of the floor.
inline Camera camera_of_lit_wall(float distance) { return narrow_camera({0, 0.5f, distance + 0.3f}, {0, 0, distance}); }

// The form factor from a point of the floor, at distance d from the middle of the lower edge, to the wall.
inline double form_factor_of_lit_wall(double d) {
  const double root = std::sqrt(d * d + 1);
  return (std::atan(0.5 / d) - d / root * std::atan(0.5 / root)) / double{kPi};
}

}  // namespace etendue::stress
