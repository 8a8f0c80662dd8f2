// Heterogeneous media with albedo one in a uniform sky: chromatic, thin, in a closed body of glass.
#pragma once
#include "integrator/integrator.h"
#include "stress/case.h"

namespace etendue::stress {

inline void heterogeneous_furnace(TestContext& test) {
  struct Medium {
    const char* label;
    const char* density;
    Rgb scattering;
  };
  for (const Medium& m : {Medium{"chromatic cloud", "cloud", {12, 2, 0.1f}}, Medium{"linear", "linear", Rgb(4)},
                          Medium{"thin", "ball", Rgb(1e-3f)}})
    for (const bool in_glass : {false, true}) {
      Material ball = scene::glass(1.5f);
      ball.boundary_only = !in_glass;
      ball.medium.scattering = m.scattering;
      ball.medium.density.field = make_density(m.density);
      scene::Scene scene = uniform_sky();
      scene::add(scene, scene::sphere(1, 24, false), ball);
      const auto d = test.document(scene, narrow_camera({0.1f, 0.2f, 3}, {0.1f, 0.2f, 0}));
      for (const auto& method : unbiased_integrators()) {
        if (!integrator::find_integrator(method)->heterogeneous_media) continue;
        test.expect_mean(method, std::string(m.label) + (in_glass ? ", in glass" : ", without a surface"),
                         test.mean(TestContext::with_method(d, method), 64), 1);
      }
    }
}

inline constexpr Case kHeterogeneousFurnace{
    .name = "heterogeneous-furnace",
    .kind = Kind::parameters,
    .theory = "A medium that only scatters is invisible in a uniform sky, however its density varies",
    .run = heterogeneous_furnace};

}  // namespace etendue::stress
