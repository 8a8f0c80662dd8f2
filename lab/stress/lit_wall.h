// A unit wall under even parallel light, and a small piece of floor in front of it that gets light from the wall alone.
#pragma once
#include "stress/lab.h"

namespace etendue::stress {

// The wall stands at z = 0 over x from -1/2 to 1/2, y from 0 to 1, and gets the irradiance one; the floor of albedo 1/2
// lies at (0, 0, distance).
inline scene::Scene lit_wall(const Material& wall, float distance) {
  scene::Scene scene;
  Mat4 upright(1);
  upright[1] = Vec4(0, 0, 1, 0), upright[2] = Vec4(0, -1, 0, 0), upright[3] = Vec4(0, 0.5f, 0, 1);
  scene::add(scene, scene::quad(0.5f), wall, upright);
  Mat4 place(1);
  place[3] = Vec4(0, 0, distance, 1);
  scene::add(scene, scene::quad(0.02f * distance), scene::diffuse(Rgb(0.5f)), place);
  scene::add(scene, make_light("directional"), {});
  return scene;
}

// The floor's pixel.
inline Camera camera_of_lit_wall(float distance) { return telescope({0, 0.5f, distance + 0.3f}, {0, 0, distance}); }

// The share of what leaves the floor evenly that arrives at the wall.
inline double form_factor_of_lit_wall(double d) {
  const double far = std::sqrt(d * d + 1);
  return (std::atan(0.5 / d) - d / far * std::atan(0.5 / far)) / double{kPi};
}

}  // namespace etendue::stress
