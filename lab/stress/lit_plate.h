// A diffuse plate of 2 x 2 m with albedo 1/2 under a directional light of irradiance one.
#pragma once
#include "stress/test_context.h"

namespace etendue::stress {

inline constexpr double kRadianceOfLitPlate = 0.5 / 3.14159265358979323846;

inline scene::Scene lit_plate() {
  scene::Scene scene;
  scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0.5f)));
  const Light light = make_light("directional");
  scene::Transform downwards;
  downwards.rotation = {-std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)};
  scene::add(scene, light, downwards);
  return scene;
}

}  // namespace etendue::stress
