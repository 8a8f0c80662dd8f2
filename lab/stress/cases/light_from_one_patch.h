// A room lit by a spot light on the ceiling through one bright patch.   [Lang, sec. 9.3, Fig. 9.17]
#pragma once
#include "scene/builtin/builtin.h"
#include "stress/case.h"

namespace etendue::stress {

inline void light_from_one_patch(TestContext& test) {
  scene::Scene scene = scene::find_builtin("spot-indirect")->make();
  const Camera camera = *scene::choose_camera(scene, "");
  auto d = test.document(std::move(scene), camera);
  d.width = d.height = 16;
  constexpr uint32_t kSamples = 64;
  const auto squared_error = [&](const std::string& method) {
    return test.squared_error(TestContext::with_method(d, method + ":sampler=random"), kSamples);
  };
  test.expect_zero("path-pure", "", test.mean(TestContext::with_method(d, "path-pure"), 4).value);
  const double path = squared_error("path");
  for (const char* method : {"bdpt", "light"})
    test.expect_between(method, "variance relative to path", squared_error(method) / path, 0, 0.3);
}

inline constexpr Case kLightFromOnePatch{
    .name = "light-from-one-patch",
    .kind = Kind::heavy_tails,
    .theory =
        "All light comes from a small patch that camera paths rarely hit and light paths start from, "
        "so bidirectional methods have much less variance",
    .run = light_from_one_patch};

}  // namespace etendue::stress
