// A fire on a stone floor: an emitting medium is the only light.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {

inline Scene fire_in_corner() {
  Scene scene;
  scene.name = "Fire";
  const int stone = add_diffuse(scene, "stone", {0.45f, 0.42f, 0.4f}),
            brick = add_diffuse(scene, "brick", {0.5f, 0.25f, 0.17f});
  add(scene, "floor", rectangle({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), stone);
  add(scene, "wall", rectangle({-2, 0, -0.9f}, {4, 0, 0}, {0, 3, 0}), brick);
  const int coal = add_diffuse(scene, "coal", Rgb(0.04f));
  for (const float turn : {0.3f, 1.6f, 2.5f}) {
    Node& log = add(scene, "log", box({0.36f, 0.05f, 0.05f}), coal, rotated_y({0, 0.051f, 0}, turn));
    log.transform.translation.y += 0.03f * turn;
  }
  Material gas;
  gas.boundary_only = true;
  gas.medium.absorption = Rgb(5);
  gas.medium.scattering = Rgb(0.5f);
  gas.medium.emission = Rgb(14);
  gas.medium.temperature = 1900;
  gas.medium.density.field = make_density("flame");
  add_box(scene, "flame", add_material(scene, "flame", gas), {-0.5f, 0.11f, -0.5f}, {0.5f, 1.65f, 0.5f});

  Camera camera = look_at({0.3f, 0.95f, 3.4f}, {0, 0.75f, 0}, {0, 1, 0}, 0.65f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kFire{
    .name = "fire",
    .label = "Fire",
    .doc = "A medium that emits light with the colour of a black body and lights its surroundings",
    .make = fire_in_corner,
};

}  // namespace etendue::scene
