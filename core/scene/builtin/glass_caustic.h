// A glass ball on a diffuse floor under a small lamp; no glass between the caustic and the camera.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/lathe.h"
#include "scene/builtin/stage.h"

namespace etendue::scene {

inline Scene glass_caustic() {
  Scene scene;
  scene.name = "Glass caustic";
  add(scene, "floor", rectangle({-4, 0, 4}, {8, 0, 0}, {0, 0, -6}), add_paint(scene, "floor", {0.7f, 0.66f, 0.6f}));
  add(scene, "wall", rectangle({-4, 0, -2}, {8, 0, 0}, {0, 5, 0}), add_paint(scene, "wall", {0.35f, 0.42f, 0.5f}));
  constexpr float kRadius = 0.5f, kLift = 0.001f;  // off the floor, so that no surfaces touch
  add(scene, "glass ball", ball(kRadius, 80), add_glass(scene, "glass", 1.5f), moved({0, kRadius + kLift, 0}));
  add(scene, "lamp", ball(0.1f, 12), add_lamp(scene, "lamp", Rgb(735, 670, 570)), moved({-2.4f, 2.1f, -0.5f}));

  Camera camera = look_at({0.9f, 1.9f, 3.6f}, {0.3f, 0.35f, 0}, {0, 1, 0}, 0.6f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kGlassCaustic{
    "glass-caustic", "Caustic of a glass ball",
    "Light focused on a diffuse floor: walks from the camera find the small lamp through the glass by chance alone",
    glass_caustic};

}  // namespace etendue::scene
