// A closed room that emits, and absorbs nothing.                                             digest 8-10: F13, F14, F25
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void closed_room_of_albedo_one(Lab& lab) {
  auto d = lab.document(scene::furnace(1), look_at({0.2f, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  d.width = d.height = 8;
  for (const auto& name : unbiased_methods()) {
    for (const int depth : {1, 4, 30}) {
      const std::string method = name + ":sampler=random:roulette-start=64:max-depth=" + std::to_string(depth);
      lab.expect_mean(method, "", lab.mean(Lab::with_method(d, method), 16), depth);
    }
    lab.expect_between(name, "without a limit it ends all the same", lab.mean(Lab::with_method(d, name), 2).value, 1,
                       1e9);
  }
}

inline constexpr Case kClosedRoomOfAlbedoOne{
    "closed-room-of-albedo-one", Kind::parameters,
    "Each edge adds as much as the one before, without end: a limit of so many edges shows as many, and roulette that "
    "never lets live for certain ends walks that lose nothing",
    closed_room_of_albedo_one};

}  // namespace etendue::stress
