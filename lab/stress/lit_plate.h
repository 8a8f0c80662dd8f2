// A plate of two by two metres under even parallel light, irradiance one, albedo 1/2.
#pragma once
#include "stress/lab.h"

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
