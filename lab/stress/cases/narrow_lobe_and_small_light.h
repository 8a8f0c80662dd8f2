// A glossy metal floor of increasing roughness that mirrors a small light.   [Veach and Guibas 1995; Lang, sec. 6.6.9]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void narrow_lobe_and_small_light(TestContext& test) {
  for (const float roughness : {0.05f, 0.2f, 0.6f}) {
    scene::Scene scene;
    Material floor;
    floor.metallic = 1;
    floor.roughness = roughness;
    scene::add(scene, scene::quad(10), floor);
    Material light = scene::diffuse(Rgb(0), Rgb(1));
    Mat4 transform(1);
    transform[3] = Vec4(-1, 1, 0, 1);
    scene::add(scene, scene::sphere(0.05f, 24, false), light, transform);
    const auto d = test.document(std::move(scene), narrow_camera({1, 1, 0}, {0, 0, 0}));
    for (const char* heuristic : {"balance", "power", "maximum"}) {
      const std::string method = std::string("path:sampler=random:heuristic=") + heuristic;
      const film::Mean mean = test.mean(TestContext::with_method(d, method), 64);
      test.expect_between(method, "variance / mean^2 of a sample at roughness " + number(roughness),
                          64 * mean.variance / (mean.value * mean.value), 0, 4);
    }
  }
}

inline constexpr Case kNarrowLobeAndSmallLight{
    .name = "narrow-lobe-and-small-light",
    .kind = Kind::heavy_tails,
    .theory =
        "Light sampling and BSDF sampling alone each have a large variance at one end of the sweep; "
        "combined with multiple importance sampling neither end has",
    .run = narrow_lobe_and_small_light};

}  // namespace etendue::stress
