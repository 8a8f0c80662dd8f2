// An emitting cap of decreasing area in a diffuse sphere, where the variance is known in closed form
// (scene/builtin/integrating_sphere.h).   [Lang, sec. 9.1.1]
#pragma once
#include "scene/builtin/integrating_sphere.h"
#include "stress/case.h"

namespace etendue::stress {

inline void light_in_a_sphere(TestContext& test) {
  constexpr float kAlbedo = 0.5f;
  constexpr uint32_t kSamples = 16;
  for (const double share : {1e-2, 1e-3, 1e-4}) {
    auto d = test.document(scene::integrating_sphere(share, kAlbedo), scene::integrating_sphere_camera());
    d.width = d.height = 96;
    d.filter = film::FilterKind::box;
    const double mean = kAlbedo * share / (1 - kAlbedo);
    for (const bool connected : {false, true}) {
      if (!connected && share < 1e-3) continue;  // too few hits to estimate a deviation
      const std::string method =
          std::string(connected ? "path" : "path-pure") + ":sampler=random:roulette-start=64:max-depth=14";
      const film::Mean measured = test.mean(TestContext::with_method(d, method), kSamples);
      const std::string point = "share " + number(share) + ", ";
      // The error beyond that of the triangulation, 2e-4.
      test.expect_between(method, point + "error in standard errors",
                          std::max(0.0, std::abs(measured.value - mean) - 2e-4 * mean) / measured.standard_error, 0,
                          TestContext::kSigmas);
      const double relative = std::sqrt(kSamples * measured.variance) / measured.value;
      if (connected)
        test.expect_between(method, point + "relative deviation", relative, 0, 0.03);
      else
        test.expect_near(method, point + "relative deviation", relative,
                         std::sqrt((1 - share) * (1 - kAlbedo) / (share * (1 + kAlbedo))), 0.15);
    }
  }
}

inline constexpr Case kLightInASphere{
    .name = "light-in-a-sphere",
    .kind = Kind::heavy_tails,
    .theory =
        "If only BSDF sampling finds the light, the relative deviation of a path grows as 1 / sqrt(area "
        "of the light). With light sampling the contribution is nearly constant in a sphere",
    .run = light_in_a_sphere};

}  // namespace etendue::stress
