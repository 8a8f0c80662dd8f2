// A ball of index one that absorbs, seen along its diameter.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void optical_depth(Lab& lab) {
  for (const float depth : {0.0f, 0.1f, 1.0f, 10.0f, 100.0f}) {
    scene::Scene scene = sky();
    Material solid = scene::glass(1);
    if (depth > 0) solid.attenuation_color = Rgb(std::exp(-1.0f)), solid.attenuation_distance = 2 / depth;
    scene::add(scene, scene::sphere(1, 64, false), solid);
    auto d = lab.document(std::move(scene), telescope({0, 0.02f, 4}, {0, 0.02f, 0}));
    d = Lab::with_method(d, "path");
    const double mean = lab.mean(d, 4).value;
    // The diameter of a ball of facets is known to a thousandth; what is smaller than any float is zero.
    const double least = depth < 80 ? std::exp(-1.002 * depth) * 0.9995 : 0;
    lab.expect_between("path", "depth " + number(depth), mean, least, std::exp(-0.995 * depth) * 1.0005);
  }
}

inline constexpr Case kOpticalDepth{
    "optical-depth", Kind::parameters,
    "Light through an absorbing solid falls by Beer's law, exp(-depth), down to nothing and never below",
    optical_depth};

}  // namespace etendue::stress
