// A sphere whose shining cap is white or black.                                                        digest 8-10: F23
#pragma once
#include "scene/builtin/integrating_sphere.h"
#include "stress/case.h"

namespace etendue::stress {

inline void emitter_that_reflects(Lab& lab) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  const double reflecting = kAlbedo * kShare / (1 - kAlbedo), black = kAlbedo * kShare / (1 - kAlbedo * (1 - kShare));
  for (const auto& [cap, expected, point] : {std::tuple{scene::Cap::reflecting, reflecting, "reflecting cap"},
                                             std::tuple{scene::Cap::black, black, "black cap"}}) {
    auto d = lab.document(scene::integrating_sphere(kShare, kAlbedo, cap), scene::integrating_sphere_camera());
    for (const auto& method : unbiased_methods()) {
      const film::Mean found = lab.mean(Lab::with_method(d, method + ":sampler=random"), 8);
      // What triangles change stands beside the noise.
      lab.expect_near(method, point, found.value, expected, 2e-4 + Lab::kSigmas * found.standard_error / expected);
    }
  }
}

inline constexpr Case kEmitterThatReflects{
    "emitter-that-reflects", Kind::bias,
    "A walk that ends where it meets a light misses what the light reflects: only of black ones is that the whole, "
    "here it would be a tenth too dark",
    emitter_that_reflects};

}  // namespace etendue::stress
