// The Cornell box with a chrome and a glass sphere instead of the blocks, as in Jensen's photon mapping images
// [Lang, fig. 9.38].
#pragma once
#include "scene/builtin/cornell.h"
#include "scene/builtin/lathe.h"

namespace etendue::scene {

inline Scene cornell_spheres() {
  Scene scene = cornell::room("Cornell box with spheres");
  constexpr float kRadius = 1, kLift = 0.002f;  // above the floor, so that no surfaces touch
  const auto mesh = ball(kRadius, 64);
  add(scene, "chrome sphere", mesh, add_metal(scene, "chrome", Rgb(0.9f), 0),
      translated({3.95f, kRadius + kLift, 3.9f}));
  add(scene, "glass sphere", mesh, add_glass(scene, "glass", 1.5f), translated({1.65f, kRadius + kLift, 1.9f}));
  cornell::add_camera(scene);
  return scene;
}

inline constexpr Builtin kCornellSpheres{
    .name = "cornell-spheres",
    .label = "Cornell box with spheres",
    .doc = "A mirror sphere and a glass sphere: caustics and their reflections next to soft diffuse light",
    .make = cornell_spheres,
};

}  // namespace etendue::scene
