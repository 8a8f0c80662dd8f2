// A furnace with vertex normals that point outwards and are not normalised.   [glTF 2.0, sec. 3.7.2]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void inverted_normals(TestContext& test) {
  for (const float length : {1.0f, 1e-3f, 1e3f}) {
    auto mesh = std::make_shared<Mesh>(*scene::sphere(1, 48, true));
    for (const auto& p : mesh->positions) mesh->normals.push_back(p * length);
    scene::Scene scene;
    scene::add(scene, mesh, scene::diffuse(Rgb(0.5f), Rgb(1)));
    const auto d = test.document(std::move(scene), look_at({0.1f, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
    for (const auto& method : unbiased_integrators())
      test.expect_near(method, "length " + number(length), test.mean(TestContext::with_method(d, method), 64).value, 2,
                       0.02);
  }
}

inline constexpr Case kInvertedNormals{
    .name = "inverted-normals",
    .kind = Kind::geometry,
    .theory =
        "Shading normals are flipped to the visible side and normalised, so a diffuse furnace does "
        "not depend on them",
    .run = inverted_normals};

}  // namespace etendue::stress
