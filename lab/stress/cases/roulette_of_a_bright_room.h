// A furnace in which paths have hundreds of segments on average.   [Arvo and Kirk 1990; Lang, sec. 9.1.1]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void roulette_of_a_bright_room(TestContext& test) {
  for (const float albedo : {0.9f, 0.99f}) {
    const auto d = test.document(scene::furnace(albedo), look_at({0.2f, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
    for (const auto& name : unbiased_integrators())
      for (const char* start : {"1", "8"}) {
        const std::string method = name + ":sampler=random:roulette-start=" + start;
        test.expect_mean(method, "albedo " + number(albedo), test.mean(TestContext::with_method(d, method), 8),
                         1 / (1 - double{albedo}));
      }
  }
}

inline constexpr Case kRouletteOfABrightRoom{
    .name = "roulette-of-a-bright-room",
    .kind = Kind::bias,
    .theory = "Russian roulette is unbiased: the mean is 1 / (1 - albedo) for any depth at which it starts",
    .run = roulette_of_a_bright_room};

}  // namespace etendue::stress
