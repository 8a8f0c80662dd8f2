// A furnace with paths truncated after a number of segments.   [Lang, sec. 6.7.2, eq. 6.589]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void depth_cut_off(TestContext& test) {
  constexpr float kAlbedo = 0.7f;
  const auto d = test.document(scene::furnace(kAlbedo), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  for (const auto& name : unbiased_integrators())
    for (const int depth : {1, 2, 5, 20}) {
      const std::string method = name + ":roulette-start=64:max-depth=" + std::to_string(depth);
      test.expect_near(method, "", test.mean(TestContext::with_method(d, method), 64).value,
                       (1 - std::pow(double{kAlbedo}, depth)) / (1 - double{kAlbedo}), 2e-3);
    }
}

inline constexpr Case kDepthCutOff{
    .name = "depth-cut-off",
    .kind = Kind::bias,
    .theory =
        "A furnace of emission 1 shows exactly the partial sum (1 - albedo^depth) / (1 - albedo) of "
        "the Neumann series",
    .run = depth_cut_off};

}  // namespace etendue::stress
