// A furnace with triangles that are points and lines.   [Möller and Trumbore 1997]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void triangles_without_area(TestContext& test) {
  auto mesh = std::make_shared<Mesh>(*scene::cube(1, true));
  for (uint32_t i = 0; i < 8; ++i) {
    mesh->triangles.push_back({i, i, i});
    mesh->triangles.push_back({i, i + 1, i});
  }
  scene::Scene scene;
  scene::add(scene, mesh, scene::diffuse(Rgb(0.5f), Rgb(1)));
  const auto d = test.document(std::move(scene), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  for (const auto& method : unbiased_integrators())
    test.expect_near(method, "", test.mean(TestContext::with_method(d, method), 64).value, 2, 5e-3);
}

inline constexpr Case kTrianglesWithoutArea{
    .name = "triangles-without-area",
    .kind = Kind::geometry,
    .theory =
        "Degenerate triangles are hit by no ray and emit nothing, and light sampling by area never "
        "selects them",
    .run = triangles_without_area};

}  // namespace etendue::stress
