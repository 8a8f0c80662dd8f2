// Media with albedo one in a uniform sky: chromatic, forward and backward scattering, inside glass and without a surface.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void scattering_furnace(TestContext& test) {
  struct Medium {
    const char* label;
    Rgb scattering;
    double g;
  };
  for (const Medium& m : {Medium{"chromatic", {8, 1, 0.1f}, 0.0}, Medium{"forward", Rgb(4), 0.95},
                          Medium{"backward", Rgb(2), -0.95}, Medium{"thin", Rgb(1e-3f), 0.5}})
    for (const bool in_glass : {false, true}) {
      Material ball = scene::glass(1.5f);
      ball.boundary_only = !in_glass;
      ball.medium.scattering = m.scattering;
      ball.medium.phase.function = make_phase_function("henyey-greenstein")->with("g", m.g);
      scene::Scene scene = uniform_sky();
      scene::add(scene, scene::sphere(1, 24, false), ball);
      const auto d = test.document(scene, narrow_camera({0.1f, 0.2f, 3}, {0.1f, 0.2f, 0}));
      for (const auto& method : unbiased_integrators()) {
        if (!integrator::find_integrator(method)->scattering_media) continue;
        test.expect_mean(method, std::string(m.label) + (in_glass ? ", in glass" : ", without a surface"),
                         test.mean(TestContext::with_method(d, method), 64), 1);
      }
    }
}

inline constexpr Case kScatteringFurnace{
    .name = "scattering-furnace",
    .kind = Kind::parameters,
    .theory = "A medium that only scatters is invisible in a uniform sky, for any phase function and colour",
    .run = scattering_furnace};

}  // namespace etendue::stress
