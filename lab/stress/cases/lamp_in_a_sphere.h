// A cap of shrinking area that shines on the rest of a diffuse sphere: every walk's worth is known in closed form.
//                                                                                                       digest 8-10: F3
#pragma once
#include "scene/builtin/integrating_sphere.h"
#include "stress/case.h"

namespace etendue::stress {

inline void lamp_in_a_sphere(Lab& lab) {
  constexpr float kAlbedo = 0.5f;
  constexpr uint32_t kSamples = 16;
  for (const double share : {1e-2, 1e-3, 1e-4}) {
    auto d = lab.document(scene::integrating_sphere(share, kAlbedo), scene::integrating_sphere_camera());
    d.width = d.height = 96;
    d.filter = film::FilterKind::box;
    const double mean = kAlbedo * share / (1 - kAlbedo);
    for (const bool connected : {false, true}) {
      if (!connected && share < 1e-3) continue;  // a dozen hits say nothing about their deviation
      const std::string method =
          std::string(connected ? "path" : "path-pure") + ":sampler=random:roulette-start=64:max-depth=14";
      const film::Mean found = lab.mean(Lab::with_method(d, method), kSamples);
      const std::string point = "share " + number(share) + ", ";
      // What triangles change stands beside the noise.
      lab.expect_between(method, point + "error in standard errors",
                         std::max(0.0, std::abs(found.value - mean) - 2e-4 * mean) / found.standard_error, 0,
                         Lab::kSigmas);
      const double relative = std::sqrt(kSamples * found.variance) / found.value;
      if (connected)
        lab.expect_between(method, point + "relative deviation", relative, 0, 0.03);
      else
        lab.expect_near(method, point + "relative deviation", relative,
                        std::sqrt((1 - share) * (1 - kAlbedo) / (share * (1 + kAlbedo))), 0.15);
    }
  }
}

inline constexpr Case kLampInASphere{
    "lamp-in-a-sphere", Kind::heavy_tails,
    "Where chance alone finds the light, the relative deviation of a walk grows as one over the root of its area; "
    "connections are worth the same everywhere in a sphere and hardly deviate at all",
    lamp_in_a_sphere};

}  // namespace etendue::stress
