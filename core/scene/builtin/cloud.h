// A procedural cloud above a plain, under a sun and a sky.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {

inline Scene cloud_over_plain() {
  Scene scene;
  scene.name = "Cloud";
  add(scene, "plain", rectangle({-60, 0, 60}, {120, 0, 0}, {0, 0, -120}),
      add_diffuse(scene, "plain", {0.2f, 0.26f, 0.12f}));
  Material vapour;
  vapour.boundary_only = true;
  vapour.medium.scattering = Rgb(10);
  vapour.medium.phase.function = make_phase_function("henyey-greenstein")->with("g", 0.6);
  vapour.medium.density.field = make_density("cloud");
  add_box(scene, "cloud", add_material(scene, "cloud", vapour), {-3.4f, 1.6f, -2.6f}, {3.4f, 5.6f, 2.6f});
  Light sun = make_light("directional", {{"intensity", 4.0}});
  sun.color = {1, 0.93f, 0.82f};
  add(scene, "sun", sun, look_at({4, 5, 2.5f}, Vec3(0), {0, 1, 0}, 1).to_world);
  scene.environment.tint = {0.22f, 0.38f, 0.68f};

  Camera camera = look_at({0.5f, 1.2f, 11}, {0, 3, 0}, {0, 1, 0}, 0.52f);
  camera.aspect = 1.5f;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kCloud{
    .name = "cloud",
    .label = "Cloud",
    .doc = "A heterogeneous medium: a cloud of fractal noise that the sun and the sky light from outside",
    .make = cloud_over_plain,
};

}  // namespace etendue::scene
