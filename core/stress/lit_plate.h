// A plate of two by two metres under even parallel light, irradiance one, albedo 1/2.
#pragma once
#include "stress/lab.h"

namespace etendue::stress {

inline constexpr double kRadianceOfLitPlate = 0.5 / 3.14159265358979323846;

inline scene::Scene lit_plate() {
  scene::Scene scene;
  scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0.5f)));
  Light light;
  light.type = LightType::directional;
  scene.lights.push_back(light);
  scene::Node node;
  node.light = 0;
  node.transform.rotation = {-std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)};  // downwards
  scene.nodes.push_back(node);
  scene.roots.push_back(static_cast<int>(scene.nodes.size()) - 1);
  return scene;
}

}  // namespace etendue::stress
