// A closed room of lossless mirrors that emit one.                                                     digest 8-10: F14
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void hall_of_mirrors(Lab& lab) {
  scene::Scene scene = scene::furnace(1);
  Material& mirror = scene.materials[0];
  mirror.base_color = Rgb(1), mirror.metallic = 1, mirror.roughness = 0, mirror.specular = 1;
  const auto d = lab.document(std::move(scene), look_at({0.1f, 0, 0}, {0.2f, 0.3f, 1}, {0, 1, 0}, 1));
  for (const int depth : {1, 5, 16, 100})
    for (const char* name : {"whitted", "path:roulette-start=64", "distribution:roulette-start=64:branches-1=1"}) {
      // Roulette would add noise to what is the same for every path.
      if (depth > 64 && std::string_view(name) != "whitted") continue;
      const std::string method = std::string(name) + ":max-depth=" + std::to_string(depth);
      lab.expect_near(method, "", lab.mean(Lab::with_method(d, method), 4).value, depth, 1e-4);
    }
  lab.expect_near("whitted", "its own limit", lab.mean(Lab::with_method(d, "whitted"), 4).value, 16, 1e-4);
}

inline constexpr Case kHallOfMirrors{
    "hall-of-mirrors", Kind::parameters,
    "Between mirrors that lose nothing radiance grows by one with each edge: what is shown is the longest path",
    hall_of_mirrors};

}  // namespace etendue::stress
