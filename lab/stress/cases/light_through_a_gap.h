// A room lit from the next room through a door ajar.   [Lang, sec. 9.4; Veach and Guibas 1997]
#pragma once
#include "scene/builtin/builtin.h"
#include "stress/case.h"

namespace etendue::stress {

inline void light_through_a_gap(TestContext& test) {
  scene::Scene scene = scene::find_builtin("door-ajar")->make();
  const Camera camera = *scene::choose_camera(scene, "");
  auto d = test.document(std::move(scene), camera);
  d.width = d.height = 16;
  constexpr uint32_t kSamples = 64;
  const auto squared_error = [&](const std::string& method) {
    return test.squared_error(TestContext::with_method(d, method + ":sampler=random"), kSamples);
  };
  const double path = squared_error("path");
  for (const char* method : {"bdpt", "pssmlt"})
    test.expect_between(method, "variance relative to path", squared_error(method) / path, 0, 0.8);
}

inline constexpr Case kLightThroughAGap{
    .name = "light-through-a-gap",
    .kind = Kind::heavy_tails,
    .theory =
        "Few camera paths pass the gap; bidirectional paths meet behind it, and Markov chains that "
        "have passed it do so again",
    .run = light_through_a_gap};

}  // namespace etendue::stress
