// From inside a glass cube to its upper face, just below and just above the critical angle.   [Lang, sec. 4.2.1.3]
#pragma once
#include <cmath>

#include "stress/case.h"

namespace etendue::stress {

inline void total_reflection(TestContext& test) {
  constexpr double kIor = 1.5;
  const double critical = std::asin(1 / kIor);
  for (const double degrees : {0.0, 30.0, 41.76, 41.86, 43.0}) {
    const double angle = degrees * 3.14159265358979 / 180;
    scene::Scene scene = uniform_sky();
    scene::add(scene, scene::cube(1, false), scene::glass(static_cast<float>(kIor)));
    // Light that leaves through the lower face hits a black floor. At the side faces it is totally reflected, if it
    // hits them at all.
    Mat4 transform(1);
    transform[3] = Vec4(0, -1.5f, 0, 1);
    scene::add(scene, scene::quad(100), scene::diffuse(Rgb(0)), transform);
    const Vec3 up(static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)), 0);
    const auto d = test.document(std::move(scene), look_at({0, 0, 0}, up, {0, 0, 1}, 1e-4f));
    double expected = 0;
    if (angle < critical) {
      const double in = std::cos(angle), out = std::sqrt(1 - std::pow(kIor * std::sin(angle), 2));
      const double s = (kIor * in - out) / (kIor * in + out), p = (in - kIor * out) / (in + kIor * out);
      expected = kIor * kIor / (1 + (s * s + p * p) / 2);
    }
    // The depth limit ends paths that are trapped by total reflection.
    for (const auto& method : unbiased_integrators()) {
      const std::string limited = method + ":max-depth=64";
      test.expect_mean(limited, "at " + number(degrees) + " degrees",
                       test.mean(TestContext::with_method(d, limited), 64), expected);
    }
  }
}

inline constexpr Case kTotalReflection{
    .name = "total-reflection",
    .kind = Kind::parameters,
    .theory =
        "Light is reflected between both faces, so a sky of radiance one appears as n^2 / (1 + F) "
        "below the critical angle arcsin(1/n), and nothing passes above it",
    .run = total_reflection};

}  // namespace etendue::stress
