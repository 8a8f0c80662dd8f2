// Bodies of wax with edges, a thin part and a round part, lit from behind and from above. They show where diffusion
// profiles deviate from the random walk: `material.N.model` of the wax can be set to `dipole` or `subsurface`.
#pragma once
#include "medium/medium.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/lathe.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {

inline Scene bodies_of_wax() {
  Scene scene;
  scene.name = "Wax";
  // Metres.
  add(scene, "table", rectangle({-0.3f, 0, 0.3f}, {0.6f, 0, 0}, {0, 0, -0.6f}),
      add_diffuse(scene, "table", {0.12f, 0.13f, 0.15f}));
  Material material = glass(1.3f);
  material.medium.scattering = Rgb(500);  // 1/m: a mean free path of about 2 mm
  material.medium.absorption = {4, 12, 50};
  const int wax = add_material(scene, "wax", material);
  constexpr float kLift = 0.0005f;  // above the table, so that no surfaces touch
  add(scene, "cube", box(Vec3(0.02f)), wax, rotated_y({-0.055f, 0.02f + kLift, 0}, 0.6f));
  add(scene, "plate", box({0.025f, 0.0275f, 0.0015f}), wax, rotated_y({0.005f, 0.0275f + kLift, -0.02f}, -0.2f));
  add(scene, "ball", ball(0.022f, 64), wax, translated({0.062f, 0.022f + kLift, 0}));
  add(scene, "light", rectangle({-0.35f, 0.12f, -0.4f}, {0.6f, 0, 0}, {0, 0.3f, 0.3f}),
      add_emitter(scene, "light", Rgb(4, 3.9f, 3.7f)));
  add(scene, "fill light", rectangle({-0.3f, 0.5f, -0.1f}, {0.6f, 0, 0}, {0, 0, 0.6f}),
      add_emitter(scene, "fill light", Rgb(0.8f, 0.9f, 1)));

  Camera camera = look_at({0.01f, 0.11f, 0.26f}, {0.003f, 0.022f, 0}, {0, 1, 0}, 0.62f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kWax{
    .name = "wax",
    .label = "Wax",
    .doc =
        "A cube, a thin plate and a ball of wax: light travels millimetres below the surface and leaves at "
        "edges",
    .make = bodies_of_wax,
};

}  // namespace etendue::scene
