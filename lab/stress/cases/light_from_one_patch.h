// A room that a spot light on the ceiling lights by way of one bright patch.                  digest 8-10: F6, Fig 9.17
#pragma once
#include "scene/builtin/builtin.h"
#include "stress/case.h"

namespace etendue::stress {

inline void light_from_one_patch(Lab& lab) {
  scene::Scene scene = scene::find_builtin("spot-indirect")->make();
  const Camera camera = *scene::choose_camera(scene, "");
  auto d = lab.document(std::move(scene), camera);
  d.width = d.height = 16;
  constexpr uint32_t kSamples = 64;
  const auto squared_error = [&](const std::string& method) {
    return lab.squared_error(Lab::with_method(d, method + ":sampler=random"), kSamples);
  };
  lab.expect_zero("path-pure", "", lab.mean(Lab::with_method(d, "path-pure"), 4).value);
  const double path = squared_error("path");
  for (const char* method : {"bdpt", "light"})
    lab.expect_between(method, "squared error over that of path", squared_error(method) / path, 0, 0.3);
}

inline constexpr Case kLightFromOnePatch{
    "light-from-one-patch", Kind::heavy_tails,
    "All light comes from a small patch that walks from the camera seldom meet and walks from the light begin with",
    light_from_one_patch};

}  // namespace etendue::stress
