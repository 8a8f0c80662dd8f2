// A diffuse sphere with an emitting cap that reflects or is black.   [Lang, sec. 9.1.1; Kajiya 1986]
#pragma once
#include "scene/builtin/integrating_sphere.h"
#include "stress/case.h"

namespace etendue::stress {

inline void emitter_that_reflects(TestContext& test) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  const double reflecting = kAlbedo * kShare / (1 - kAlbedo), black = kAlbedo * kShare / (1 - kAlbedo * (1 - kShare));
  for (const auto& [cap, expected, point] : {std::tuple{scene::Cap::reflecting, reflecting, "reflecting cap"},
                                             std::tuple{scene::Cap::black, black, "black cap"}}) {
    auto d = test.document(scene::integrating_sphere(kShare, kAlbedo, cap), scene::integrating_sphere_camera());
    for (const auto& method : unbiased_integrators()) {
      const film::Mean mean = test.mean(TestContext::with_method(d, method + ":sampler=random"), 8);
      // The first term bounds the error of the triangulation.
      test.expect_near(method, point, mean.value, expected,
                       2e-4 + TestContext::kSigmas * mean.standard_error / expected);
    }
  }
}

inline constexpr Case kEmitterThatReflects{
    .name = "emitter-that-reflects",
    .kind = Kind::bias,
    .theory =
        "Paths that end at the first emitter they hit miss the light that it reflects. This light is a "
        "tenth of the radiance here, and zero only for black emitters",
    .run = emitter_that_reflects};

}  // namespace etendue::stress
