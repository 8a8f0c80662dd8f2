// A furnace whose vertex normals point outwards, and are not of unit length.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void inverted_normals(Lab& lab) {
  for (const float length : {1.0f, 1e-3f, 1e3f}) {
    auto mesh = std::make_shared<Mesh>(*scene::sphere(1, 48, true));
    for (const auto& p : mesh->positions) mesh->normals.push_back(p * length);
    scene::Scene scene;
    scene::add(scene, mesh, scene::diffuse(Rgb(0.5f), Rgb(1)));
    const auto d = lab.document(std::move(scene), look_at({0.1f, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
    for (const auto& method : unbiased_methods())
      lab.expect_near(method, "length " + number(length), lab.mean(Lab::with_method(d, method), 64).value, 2, 0.02);
  }
}

inline constexpr Case kInvertedNormals{"inverted-normals", Kind::geometry,
                                       "Shading normals that point to the back are turned to the front: a Lambertian "
                                       "furnace does not notice them, whatever their length",
                                       inverted_normals};

}  // namespace etendue::stress
