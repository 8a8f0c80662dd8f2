// The Cornell room with a chrome and a glass ball in the place of the boxes, as in Jensen's pictures of photon maps
// (thesis, figure 9.38).
#pragma once
#include "scene/builtin/cornell.h"
#include "scene/builtin/lathe.h"

namespace etendue::scene {

inline Scene cornell_spheres() {
  Scene scene = cornell::room("Cornell box with spheres");
  constexpr float kRadius = 1, kLift = 0.002f;  // off the floor, so that no surfaces touch
  const auto mesh = ball(kRadius, 64);
  add(scene, "chrome ball", mesh, add_metal(scene, "chrome", Rgb(0.9f), 0), moved({3.95f, kRadius + kLift, 3.9f}));
  add(scene, "glass ball", mesh, add_glass(scene, "glass", 1.5f), moved({1.65f, kRadius + kLift, 1.9f}));
  cornell::add_camera(scene);
  return scene;
}

inline constexpr Builtin kCornellSpheres{
    "cornell-spheres", "Cornell box with spheres",
    "A mirror and a lens: caustics on floor and wall, and their reflections, beside soft diffuse light",
    cornell_spheres};

}  // namespace etendue::scene
