// Successive over-relaxation with factors up to 2 and beyond.   [Lang, eq. 2.523, 2.524]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void radiosity_relaxation_factor(TestContext& test) {
  const auto d = test.document(scene::furnace(0.5f), Camera());
  for (const char* factor : {"0.5", "1", "1.5", "1.9", "2", "2.5"}) {
    const std::string method =
        std::string("radiosity:patches=100:rays=64:light-samples=4096:tolerance=0.0001:solver=sor:relaxation=") +
        factor;
    // Radiance 2 if it converges; emitted light and one reflection of it if it diverges.
    test.expect_near(std::string("radiosity:solver=sor:relaxation=") + factor, "radiance of a room of albedo 0.5",
                     test.mean(TestContext::with_method(d, method), 2).value, std::stod(factor) < 2 ? 2 : 1.5, 0.01);
  }
}

inline constexpr Case kRadiosityRelaxationFactor{
    .name = "radiosity-relaxation-factor",
    .kind = Kind::parameters,
    .theory =
        "Over-relaxation of a symmetric positive definite system converges for factors between 0 and 2 only. From 2 "
        "on, "
        "divergence is detected, and the image shows emitted and direct light",
    .run = radiosity_relaxation_factor};

}  // namespace etendue::stress
