// A prism of flint glass in the direction of minimum deviation. Through it, the camera sees a narrow white light as a
// spectrum.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {
namespace prism {

// Metres. The cross section is an equilateral triangle.
inline constexpr float kSide = 0.6f, kHeight = 0.7f, kSlitDistance = 1.4f;

// Horizontal directions: of the ray inside the prism and towards its apex, for a ray from the camera at minimum
// deviation, and the direction in which that ray leaves the prism.
struct Directions {
  Vec3 inside, apex, leaving;

  // The centres of the faces that light passes.
  Vec3 entry, exit;

  // For an index of refraction: sin(incidence) = n sin(30 degrees), and the ray turns by incidence - 30 degrees.
  explicit Directions(float index) {
    const float turn = std::asin(0.5f * index) - kPi / 6;
    const float c = std::cos(turn), s = std::sin(turn);
    inside = Vec3(s, 0, -c);
    apex = Vec3(-c, 0, -s);
    leaving = c * inside - s * apex;
    entry = 0.25f * (kSide / std::sqrt(3.0f) * apex - kSide * inside);
    exit = entry + 0.5f * kSide * inside;
  }
};

// Stands on the plane y = 0.
inline std::shared_ptr<const Mesh> body(const Directions& to) {
  const float radius = kSide / std::sqrt(3.0f);
  const Vec3 corners[] = {to.apex * radius, -0.5f * radius * to.apex - 0.5f * kSide * to.inside,
                          -0.5f * radius * to.apex + 0.5f * kSide * to.inside};
  Mesh mesh;
  mesh.positions.reserve(7);  // Embree reads 16 bytes at the last vertex
  for (const float y : {0.0f, kHeight})
    for (const Vec3& corner : corners) mesh.positions.push_back(corner + Vec3(0, y, 0));
  mesh.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace prism

inline Scene prism_scene() {
  Scene scene;
  scene.name = "Prism";
  const SellmeierFormula& flint = *find_sellmeier(Glass::n_sf11);
  Material glass_material = glass(static_cast<float>(flint.index_d()));
  glass_material.dispersion = static_cast<float>(flint.dispersion());
  glass_material.glass = flint.glass;
  const prism::Directions to(glass_material.ior);

  add(scene, "floor", rectangle({-3, 0, 4}, {6, 0, 0}, {0, 0, -7}), add_diffuse(scene, "floor", {0.3f, 0.3f, 0.3f}));
  constexpr float kLift = 0.001f;  // above the floor, so that no surfaces touch
  add(scene, "prism", prism::body(to), add_material(scene, "flint glass", glass_material), translated({0, kLift, 0}));
  // A slit that faces the prism.
  constexpr float kWidth = 0.025f, kSlitHeight = 0.6f;
  const Vec3 across = kWidth * glm::normalize(glm::cross(Vec3(0, 1, 0), -to.leaving));
  const Vec3 corner = to.exit + prism::kSlitDistance * to.leaving - 0.5f * across + Vec3(0, 0.05f, 0);
  add(scene, "slit", rectangle(corner, across, {0, kSlitHeight, 0}), add_emitter(scene, "slit", Rgb(8)));
  add(scene, "fill light", rectangle({-0.6f, 2.5f, 0.2f}, {1.2f, 0, 0}, {0, 0, 1.2f}),
      add_emitter(scene, "fill light", Rgb(3)));

  Camera camera = look_at(to.entry + Vec3(0, 0.5f, 3), to.entry + Vec3(0.5f, 0.32f, 0), {0, 1, 0}, 0.5f);
  camera.aspect = 16.0f / 9;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kPrism{
    .name = "prism",
    .label = "Prism",
    .doc = "A prism of flint glass shows a narrow white light as a spectrum, which needs spectral rendering",
    .make = prism_scene,
};

}  // namespace etendue::scene
