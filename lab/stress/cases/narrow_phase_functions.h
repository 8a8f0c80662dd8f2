// A slab that scatters only forwards or only backwards, in front of an emitting plate.   [Schuster 1905]
#pragma once
#include <cmath>

#include "stress/case.h"
#include "stress/cases/nested_glass.h"

namespace etendue::stress {

inline void narrow_phase_functions(TestContext& test) {
  constexpr float kDepth = 4;  // optical depth of the slab, which has a thickness of two metres
  const Camera camera = look_at({0.013f, 4, 0.017f}, {0.013f, 0, 0.017f}, {0, 0, 1}, 1e-4f);
  for (const double g : {1.0, -1.0}) {
    Material slab = scene::glass(1);
    slab.boundary_only = true;
    slab.medium.scattering = Rgb(kDepth / 2);
    slab.medium.phase.function = make_phase_function("henyey-greenstein")->with("g", g);
    scene::Scene scene;
    Mat4 wide(1);
    wide[0][0] = wide[2][2] = 30;
    scene::add(scene, scene::cube(1, false), slab, wide);
    Mat4 below = wide;
    below[3] = Vec4(0, -1.5f, 0, 1);
    scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0), Rgb(1)), below);
    const auto d = test.document(std::move(scene), camera);
    const auto mean = [&](const char* method) { return test.mean(TestContext::with_method(d, method), 64); };
    // Methods that connect vertices in the medium find such narrow lobes by chance only.
    for (const char* method : {"path-pure", "path", "distribution"})
      if (g > 0)
        // An asymmetry of one is evaluated as 0.999: up to 0.3 % of the light passes the plate.
        test.expect_between(method, "g 1", mean(method).value, 0.997, 1.001);
      else
        // Light that is scattered back and forth along a line leaves the slab on the far side with this probability.
        test.expect_mean(method, "g -1", mean(method), 1 / (1 + double{kDepth}));
  }
}

inline constexpr Case kNarrowPhaseFunctions{
    .name = "narrow-phase-functions",
    .kind = Kind::parameters,
    .theory =
        "Forward scattering with g towards 1 leaves the light as it is; backward scattering with g = -1 "
        "transmits 1 / (1 + optical depth)",
    .run = narrow_phase_functions};

}  // namespace etendue::stress
