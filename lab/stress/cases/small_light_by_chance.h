// A disk light of shrinking radius, found only when a walk happens to end on it.                        digest 8-10: F3
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void small_light_by_chance(Lab& lab) {
  for (const float radius : {0.4f, 0.2f, 0.1f}) {
    scene::Scene scene;
    scene::add(scene, scene::quad(10), scene::diffuse(Rgb(0.5f)));
    Material light = scene::diffuse(Rgb(0), Rgb(1));
    light.double_sided = false;
    Mat4 place(1);
    place[1][1] = -1, place[2][2] = -1, place[3] = Vec4(0, 1, 0, 1);
    scene::add(scene, scene::disk(radius, 96), light, place);
    auto d = lab.document(std::move(scene), telescope({3, 0.8f, 0}, {0, 0, 0}));
    d.width = d.height = 128;
    // Hit or miss with probability p: the variance over the squared mean is (1 - p) / p.
    const double p = radius * radius / (radius * radius + 1.0);
    constexpr uint32_t kSamples = 16;
    for (const bool connected : {false, true}) {
      const std::string method = connected ? "path:sampler=random" : "path-pure:sampler=random";
      const film::Mean mean = lab.mean(Lab::with_method(d, method), kSamples);
      const double relative = kSamples * mean.variance / (mean.value * mean.value);
      const std::string point = "variance / mean^2 at radius " + number(radius);
      if (connected)
        lab.expect_between(method, point, relative, 0, 0.1);
      else
        lab.expect_near(method, point, relative, (1 - p) / p, 0.12);
    }
  }
}

inline constexpr Case kSmallLightByChance{
    "small-light-by-chance", Kind::heavy_tails,
    "Variance grows as one over the light's projected solid angle when only chance finds it; with connections it stays",
    small_light_by_chance};

}  // namespace etendue::stress
