// Radiosity in a closed room whose reflectance approaches and reaches 1.   [Lang, sec. 10.1.5]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void radiosity_reflectance_to_one(TestContext& test) {
  const auto room = [&](float albedo, const std::string& solver) {
    const auto d = test.document(scene::furnace(albedo), Camera());
    const std::string method = "radiosity:patches=100:rays=64:light-samples=4096:tolerance=0.0001:solver=" + solver;
    return test.mean(TestContext::with_method(d, method), 2).value;
  };
  for (const char* solver : {"gauss-seidel", "cg", "southwell"}) {
    for (const float albedo : {0.5f, 0.9f, 0.99f})
      test.expect_near(std::string("radiosity:solver=") + solver, "albedo " + number(static_cast<double>(albedo)),
                       room(albedo, solver), 1 / (1 - static_cast<double>(albedo)), 0.01);
    // The light has no limit. The image shows emitted light and one reflection of it.
    test.expect_near(std::string("radiosity:solver=") + solver, "albedo 1, emitted and direct light", room(1, solver),
                     2, 0.02);
  }
}

inline constexpr Case kRadiosityReflectanceToOne{
    .name = "radiosity-reflectance-to-one",
    .kind = Kind::parameters,
    .theory =
        "The condition of the radiosity equation grows as 1 / (1 - reflectance). Solvers stop by a bound of the error, "
        "so "
        "they need more sweeps, and report divergence where there is no solution",
    .run = radiosity_reflectance_to_one};

}  // namespace etendue::stress
