// A closed room of lossless mirrors with emission one.   [Whitted 1980; Lang, sec. 8.3]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void hall_of_mirrors(TestContext& test) {
  scene::Scene scene = scene::furnace(1);
  Material& mirror = scene.materials[0];
  mirror.base_color = Rgb(1);
  mirror.metallic = 1;
  mirror.roughness = 0;
  mirror.specular = 1;
  const auto d = test.document(std::move(scene), look_at({0.1f, 0, 0}, {0.2f, 0.3f, 1}, {0, 1, 0}, 1));
  for (const int depth : {1, 5, 16, 100})
    for (const char* name : {"whitted", "path:roulette-start=64", "distribution:roulette-start=64:branches-1=1"}) {
      // Russian roulette would add noise; without it all paths have the same contribution.
      if (depth > 64 && std::string_view(name) != "whitted") continue;
      const std::string method = std::string(name) + ":max-depth=" + std::to_string(depth);
      test.expect_near(method, "", test.mean(TestContext::with_method(d, method), 4).value, depth, 1e-4);
    }
  test.expect_near("whitted", "default limit", test.mean(TestContext::with_method(d, "whitted"), 4).value, 16, 1e-4);
}

inline constexpr Case kHallOfMirrors{
    .name = "hall-of-mirrors",
    .kind = Kind::parameters,
    .theory =
        "Between lossless mirrors radiance grows by the emission with each segment, so the image "
        "shows the maximum path depth",
    .run = hall_of_mirrors};

}  // namespace etendue::stress
