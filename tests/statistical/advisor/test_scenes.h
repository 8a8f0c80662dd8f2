// Scenes with every kind of surface and one kind of light, and a progress callback that never cancels.
#pragma once
#include <string>

#include "support/independent_estimates.h"

namespace etendue::test {

inline bool never_cancel(double, const std::string&) { return true; }

inline render::Document sized(render::Document d, int size) {
  d.width = d.height = size;
  return d;
}

inline render::Document changed(const render::Document& d, const std::string& name, const std::string& value) {
  return *render::with_text(d, name, value);
}

// The objects of test::glossy_scene under other lights.
inline render::Document glossy_scene_under(bool area, bool sky, bool point, int size) {
  render::Document d = sized(glossy_scene(), size);
  scene::Scene scene = *d.scene;
  if (!area)
    for (Material& m : scene.materials) m.emission = Rgb(0);
  scene.environment.tint = sky ? Rgb(0.4f, 0.5f, 0.6f) : Rgb(0);
  if (point) test::add_point_light(scene, {0.5f, 3, 1.5f}, 20);
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return d;
}

}  // namespace etendue::test
