// Paths that are cut after so many edges, in a closed furnace.                                         digest 8-10: F25
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void depth_cut_off(Lab& lab) {
  constexpr float kAlbedo = 0.7f;
  const auto d = lab.document(scene::furnace(kAlbedo), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  for (const auto& name : unbiased_methods())
    for (const int depth : {1, 2, 5, 20}) {
      const std::string method = name + ":roulette-start=64:max-depth=" + std::to_string(depth);
      lab.expect_near(method, "", lab.mean(Lab::with_method(d, method), 64).value,
                      (1 - std::pow(double{kAlbedo}, depth)) / (1 - double{kAlbedo}), 2e-3);
    }
}

inline constexpr Case kDepthCutOff{"depth-cut-off", Kind::bias,
                                   "A furnace of emission 1 shows the partial sum (1 - albedo^depth) / (1 - albedo) "
                                   "of the Neumann series, no more",
                                   depth_cut_off};

}  // namespace etendue::stress
