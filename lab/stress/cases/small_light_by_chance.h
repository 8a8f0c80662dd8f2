// A disk light of decreasing radius, found by BSDF sampling only or with light sampling.   [Lang, sec. 9.1.1]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void small_light_by_chance(TestContext& test) {
  for (const float radius : {0.4f, 0.2f, 0.1f}) {
    scene::Scene scene;
    scene::add(scene, scene::quad(10), scene::diffuse(Rgb(0.5f)));
    Material light = scene::diffuse(Rgb(0), Rgb(1));
    light.double_sided = false;
    Mat4 transform(1);
    transform[1][1] = -1;
    transform[2][2] = -1;
    transform[3] = Vec4(0, 1, 0, 1);
    scene::add(scene, scene::disk(radius, 96), light, transform);
    auto d = test.document(std::move(scene), narrow_camera({3, 0.8f, 0}, {0, 0, 0}));
    d.width = d.height = 128;
    // A path hits the light with probability p, so the relative variance is (1 - p) / p.
    const double p = radius * radius / (radius * radius + 1.0);
    constexpr uint32_t kSamples = 16;
    for (const bool connected : {false, true}) {
      const std::string method = connected ? "path:sampler=random" : "path-pure:sampler=random";
      const film::Mean mean = test.mean(TestContext::with_method(d, method), kSamples);
      const double relative = kSamples * mean.variance / (mean.value * mean.value);
      const std::string point = "variance / mean^2 at radius " + number(radius);
      if (connected)
        test.expect_between(method, point, relative, 0, 0.1);
      else
        test.expect_near(method, point, relative, (1 - p) / p, 0.12);
    }
  }
}

inline constexpr Case kSmallLightByChance{
    .name = "small-light-by-chance",
    .kind = Kind::heavy_tails,
    .theory =
        "With BSDF sampling alone the variance grows as 1 / projected solid angle of the light; with "
        "light sampling it stays constant",
    .run = small_light_by_chance};

}  // namespace etendue::stress
