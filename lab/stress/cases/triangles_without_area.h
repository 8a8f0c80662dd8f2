// A furnace with triangles that are points and lines.                                                  digest 8-10: F26
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void triangles_without_area(Lab& lab) {
  auto mesh = std::make_shared<Mesh>(*scene::cube(1, true));
  for (uint32_t i = 0; i < 8; ++i) {
    mesh->triangles.push_back({i, i, i});
    mesh->triangles.push_back({i, i + 1, i});
  }
  scene::Scene scene;
  scene::add(scene, mesh, scene::diffuse(Rgb(0.5f), Rgb(1)));
  const auto d = lab.document(std::move(scene), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  for (const auto& method : unbiased_methods())
    lab.expect_near(method, "", lab.mean(Lab::with_method(d, method), 64).value, 2, 5e-3);
}

inline constexpr Case kTrianglesWithoutArea{"triangles-without-area", Kind::geometry,
                                            "Triangles that are points or lines are met by no ray and send no light: "
                                            "choosing lights by area never chooses them",
                                            triangles_without_area};

}  // namespace etendue::stress
