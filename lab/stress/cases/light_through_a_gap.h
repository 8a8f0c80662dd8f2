// A room that gets light from the next one through a gap at the door.                                   digest 8-10: F7
#pragma once
#include "scene/builtin/builtin.h"
#include "stress/case.h"

namespace etendue::stress {

inline void light_through_a_gap(Lab& lab) {
  scene::Scene scene = scene::find_builtin("door-ajar")->make();
  const Camera camera = *scene::choose_camera(scene, "");
  auto d = lab.document(std::move(scene), camera);
  d.width = d.height = 16;
  constexpr uint32_t kSamples = 64;
  const auto squared_error = [&](const std::string& method) {
    return lab.squared_error(Lab::with_method(d, method + ":sampler=random"), kSamples);
  };
  const double path = squared_error("path");
  for (const char* method : {"bdpt", "pssmlt"})
    lab.expect_between(method, "squared error over that of path", squared_error(method) / path, 0, 0.8);
}

inline constexpr Case kLightThroughAGap{
    "light-through-a-gap", Kind::heavy_tails,
    "Few walks from the camera find their way through the gap; bidirectional ones meet behind it, and chains that have "
    "been there go again",
    light_through_a_gap};

}  // namespace etendue::stress
