// An emitting sphere that is compressed to slivers and stretched back by its transform.   [Woop et al. 2013]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void slivers(TestContext& test) {
  for (const float ratio : {1.0f, 1e3f, 1e6f}) {
    scene::Scene scene;
    Mat4 squeeze(1), stretch(1);
    squeeze[0][0] = 1 / ratio;
    stretch[0][0] = ratio;
    auto mesh = std::make_shared<Mesh>(*scene::sphere(1, 24, true));
    for (auto& p : mesh->positions) p = Vec3(squeeze * Vec4(p, 1));
    mesh->positions.reserve(mesh->positions.size() + 1);
    scene::add(scene, mesh, scene::diffuse(Rgb(0.5f), Rgb(1)), stretch);
    const auto d = test.document(std::move(scene), look_at({0.1f, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
    for (const auto& method : unbiased_integrators())
      test.expect_near(method, "ratio " + number(ratio), test.mean(TestContext::with_method(d, method), 64).value, 2,
                       5e-3);
  }
}

inline constexpr Case kSlivers{
    .name = "slivers",
    .kind = Kind::geometry,
    .theory =
        "Triangles a million times longer than wide are intersected reliably, so a furnace made of "
        "them stays closed",
    .run = slivers};

}  // namespace etendue::stress
