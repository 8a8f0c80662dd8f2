// A furnace whose walks would go on for hundreds of edges.                                             digest 8-10: F13
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void roulette_of_a_bright_room(Lab& lab) {
  for (const float albedo : {0.9f, 0.99f}) {
    const auto d = lab.document(scene::furnace(albedo), look_at({0.2f, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
    for (const auto& name : unbiased_methods())
      for (const char* start : {"1", "8"}) {
        const std::string method = name + ":sampler=random:roulette-start=" + start;
        lab.expect_mean(method, "albedo " + number(albedo), lab.mean(Lab::with_method(d, method), 8),
                        1 / (1 - double{albedo}));
      }
  }
}

inline constexpr Case kRouletteOfABrightRoom{
    "roulette-of-a-bright-room", Kind::bias,
    "Ending walks at random must not darken: the mean stays 1 / (1 - albedo) wherever roulette starts",
    roulette_of_a_bright_room};

}  // namespace etendue::stress
