// A spot light behind the slats of a blind in fog: shafts of light.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {

inline Scene god_rays() {
  Scene scene;
  scene.name = "God rays";
  const int grey = add_diffuse(scene, "grey", Rgb(0.5f)), floor = add_diffuse(scene, "floor", {0.4f, 0.3f, 0.2f}),
            clay = add_diffuse(scene, "clay", {0.7f, 0.4f, 0.3f}), slat = add_diffuse(scene, "slat", Rgb(0.3f));
  add_room(scene, {-3, 0, -2}, {3, 3, 4},
           {.floor = floor, .ceiling = grey, .back = grey, .front = grey, .left = grey, .right = grey});
  constexpr int kSlats = 7;
  for (int i = 0; i < kSlats; ++i) {
    const float y = 1.35f + 0.2f * static_cast<float>(i);
    add_box(scene, "slat", slat, {-1.95f, y, -1.4f}, {-1.93f, y + 0.1f, 1.4f});
  }
  add(scene, "ball", ball(0.35f, 40), clay, translated({0.7f, 0.36f, 0}));
  Material fog;
  fog.boundary_only = true;
  fog.medium.scattering = Rgb(0.12f);
  fog.medium.phase.function = make_phase_function("henyey-greenstein")->with("g", 0.5);
  constexpr float kGap = 0.01f;  // to the walls, so that no surfaces touch
  add_box(scene, "fog", add_material(scene, "fog", fog), {-3 + kGap, kGap, -2 + kGap}, {3 - kGap, 3 - kGap, 4 - kGap});
  Light light = make_light("spot", {{"intensity", 60.0}, {"inner-cone", 0.45}, {"outer-cone", 0.55}});
  light.color = {1, 0.93f, 0.8f};
  const Vec3 place(-2.7f, 2.5f, 0);
  add(scene, "spot light", light, look_at(place, place + Vec3(1, -0.5f, 0), {0, 1, 0}, 1).to_world);

  Camera camera = look_at({0.4f, 1.4f, 3.7f}, {-0.2f, 1.3f, 0}, {0, 1, 0}, 0.85f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kGodRays{
    .name = "god-rays",
    .label = "God rays",
    .doc = "A spot light behind a blind in fog: light that is scattered once, close to the light",
    .make = god_rays,
};

}  // namespace etendue::scene
