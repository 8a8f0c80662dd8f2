// An absorbing sphere with index one, seen along its diameter.   [Lang, sec. 4.1.2; Beer 1852]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void optical_depth(TestContext& test) {
  for (const float depth : {0.0f, 0.1f, 1.0f, 10.0f, 100.0f}) {
    scene::Scene scene = uniform_sky();
    Material solid = scene::glass(1);
    if (depth > 0) {
      solid.attenuation_color = Rgb(std::exp(-1.0f));
      solid.attenuation_distance = 2 / depth;
    }
    scene::add(scene, scene::sphere(1, 64, false), solid);
    auto d = test.document(std::move(scene), narrow_camera({0, 0.02f, 4}, {0, 0.02f, 0}));
    d = TestContext::with_method(d, "path");
    const double mean = test.mean(d, 4).value;
    // The length of the chord through the triangulated sphere is known to 0.1 %. Values below the float range are zero.
    const double minimum = depth < 80 ? std::exp(-1.002 * depth) * 0.9995 : 0;
    test.expect_between("path", "depth " + number(depth), mean, minimum, std::exp(-0.995 * depth) * 1.0005);
  }
}

inline constexpr Case kOpticalDepth{
    .name = "optical-depth",
    .kind = Kind::parameters,
    .theory =
        "Transmittance through an absorbing solid is exp(-optical depth), down to zero and never "
        "negative",
    .run = optical_depth};

}  // namespace etendue::stress
