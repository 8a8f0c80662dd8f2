// A glass sphere on a diffuse floor under a small light. The caustic is visible without looking through the glass.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/lathe.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {

inline Scene glass_caustic() {
  Scene scene;
  scene.name = "Glass caustic";
  add(scene, "floor", rectangle({-4, 0, 4}, {8, 0, 0}, {0, 0, -6}), add_diffuse(scene, "floor", {0.7f, 0.66f, 0.6f}));
  add(scene, "wall", rectangle({-4, 0, -2}, {8, 0, 0}, {0, 5, 0}), add_diffuse(scene, "wall", {0.35f, 0.42f, 0.5f}));
  constexpr float kRadius = 0.5f, kLift = 0.001f;  // above the floor, so that no surfaces touch
  add(scene, "glass sphere", ball(kRadius, 80), add_glass(scene, "glass", 1.5f), translated({0, kRadius + kLift, 0}));
  add(scene, "light", ball(0.1f, 12), add_emitter(scene, "light", Rgb(735, 670, 570)),
      translated({-2.4f, 2.1f, -0.5f}));

  Camera camera = look_at({0.9f, 1.9f, 3.6f}, {0.3f, 0.35f, 0}, {0, 1, 0}, 0.6f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kGlassCaustic{
    .name = "glass-caustic",
    .label = "Glass caustic",
    .doc =
        "A glass sphere focuses a small light on a diffuse floor: camera paths hit the light through the glass only by "
        "chance",
    .make = glass_caustic,
};

}  // namespace etendue::scene
