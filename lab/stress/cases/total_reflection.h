// From inside a cube of glass up to its lid, just below and just above the angle of total reflection.
#pragma once
#include <cmath>

#include "stress/case.h"

namespace etendue::stress {

inline void total_reflection(Lab& lab) {
  constexpr double kIor = 1.5;
  const double critical = std::asin(1 / kIor);
  for (const double degrees : {0.0, 30.0, 41.76, 41.86, 43.0}) {
    const double angle = degrees * 3.14159265358979 / 180;
    scene::Scene scene = sky();
    scene::add(scene, scene::cube(1, false), scene::glass(static_cast<float>(kIor)));
    // What leaves through the floor of the cube meets a black one; the walls are beyond their own angle, or not met.
    Mat4 place(1);
    place[3] = Vec4(0, -1.5f, 0, 1);
    scene::add(scene, scene::quad(100), scene::diffuse(Rgb(0)), place);
    const Vec3 up(static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)), 0);
    const auto d = lab.document(std::move(scene), look_at({0, 0, 0}, up, {0, 0, 1}, 1e-4f));
    double expected = 0;
    if (angle < critical) {
      const double in = std::cos(angle), out = std::sqrt(1 - std::pow(kIor * std::sin(angle), 2));
      const double s = (kIor * in - out) / (kIor * in + out), p = (in - kIor * out) / (in + kIor * out);
      expected = kIor * kIor / (1 + (s * s + p * p) / 2);
    }
    // Rays that are shut in would go on for long.
    for (const auto& method : unbiased_methods()) {
      const std::string cut = method + ":max-depth=64";
      lab.expect_mean(cut, "at " + number(degrees) + " degrees", lab.mean(Lab::with_method(d, cut), 64), expected);
    }
  }
}

inline constexpr Case kTotalReflection{
    "total-reflection", Kind::parameters,
    "Light goes up and down between lid and floor, so a sky of one is seen as n^2 / (1 + F); from the angle with sine "
    "1/n on nothing passes, and what is inside stays there",
    total_reflection};

}  // namespace etendue::stress
