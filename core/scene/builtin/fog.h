// The Cornell box filled with fog.
#pragma once
#include "scene/builtin/cornell.h"

namespace etendue::scene {

inline Scene foggy_cornell_box() {
  Scene scene = cornell_box();
  scene.name = "Cornell box in fog";
  Material fog;
  fog.boundary_only = true;
  fog.medium.scattering = Rgb(0.2f);
  fog.medium.phase.function = make_phase_function("mie-hazy");
  constexpr float kGap = 0.01f;  // to the walls, so that no surfaces touch
  add_box(scene, "fog", add_material(scene, "fog", fog), {kGap, kGap, kGap},
          Vec3(5.49f, cornell::kHeight * cornell::kMetres - kGap, 5.58f));
  return scene;
}

inline constexpr Builtin kFog{
    .name = "fog",
    .label = "Cornell box in fog",
    .doc = "Light is scattered on its way between surfaces: only integrators with scattering media render it",
    .make = foggy_cornell_box,
};

}  // namespace etendue::scene
