// A closed emitting room that absorbs nothing.   [Lang, sec. 6.7.2]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void closed_room_of_albedo_one(TestContext& test) {
  auto d = test.document(scene::furnace(1), look_at({0.2f, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  d.width = d.height = 8;
  for (const auto& name : unbiased_integrators()) {
    for (const int depth : {1, 4, 30}) {
      const std::string method = name + ":sampler=random:roulette-start=64:max-depth=" + std::to_string(depth);
      test.expect_mean(method, "", test.mean(TestContext::with_method(d, method), 16), depth);
    }
    test.expect_between(name, "terminates without a limit", test.mean(TestContext::with_method(d, name), 2).value, 1,
                        1e9);
  }
}

inline constexpr Case kClosedRoomOfAlbedoOne{
    .name = "closed-room-of-albedo-one",
    .kind = Kind::parameters,
    .theory =
        "Every bounce adds as much radiance as the previous one, so a limit of d segments yields d times "
        "the emission. Paths without a limit end because Russian roulette never survives with certainty",
    .run = closed_room_of_albedo_one};

}  // namespace etendue::stress
