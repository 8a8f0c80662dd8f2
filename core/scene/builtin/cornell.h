// The Cornell box: corners in millimetres and reflectances as published by the Cornell University Program of Computer
// Graphics, 1998.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {
namespace cornell {

// One published unit is a millimetre. Scaled by ten, the box is a room of 5.6 m.
inline constexpr float kMetres = 0.01f;

using Corners = std::array<Vec3, 4>;

// Corners in published order: counter-clockwise as seen from the lit side.
inline constexpr float kWidth = 552.8f, kDepth = 559.2f, kHeight = 548.8f;

inline std::shared_ptr<const Mesh> mesh_of(const std::string& name, const std::vector<Corners>& quads) {
  auto mesh = std::make_shared<Mesh>();
  mesh->name = name;
  mesh->positions.reserve(quads.size() * 4 + 1);
  for (const Corners& corners : quads) {
    const auto first = static_cast<uint32_t>(mesh->positions.size());
    for (const Vec3& corner : corners) mesh->positions.push_back(corner * kMetres);
    mesh->triangles.push_back({first, first + 1, first + 2});
    mesh->triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

inline void add_quads(Scene& scene, const char* name, int material, const std::vector<Corners>& quads) {
  add(scene, name, mesh_of(name, quads), material);
}

// A block on the floor from the four corners of its top, in either order. All faces are oriented outwards.
inline std::vector<Corners> block(const Corners& top) {
  std::vector<Corners> quads{top};
  const Vec3 middle = 0.25f * (top[0] + top[1] + top[2] + top[3]);
  for (size_t i = 0; i < 4; ++i) {
    const Vec3 a = top[i], b = top[(i + 1) % 4];
    Corners side{a, Vec3(a.x, 0, a.z), Vec3(b.x, 0, b.z), b};
    const Vec3 normal = glm::cross(side[1] - side[0], side[2] - side[0]);
    if (glm::dot(normal, a + b - 2.0f * middle) < 0) side = {b, Vec3(b.x, 0, b.z), Vec3(a.x, 0, a.z), a};
    quads.push_back(side);
  }
  const Vec3 up = glm::cross(top[1] - top[0], top[2] - top[0]);
  if (up.y < 0) quads[0] = {top[3], top[2], top[1], top[0]};
  return quads;
}

// The room with its light and without blocks.
inline Scene room(const char* name) {
  Scene scene;
  scene.name = name;
  // The measured reflectance spectra under the spectrum of the light, as linear Rec. 709.
  const int white = add_diffuse(scene, "white", {0.725f, 0.71f, 0.68f}),
            red = add_diffuse(scene, "red", {0.63f, 0.065f, 0.05f}),
            green = add_diffuse(scene, "green", {0.14f, 0.45f, 0.091f}),
            light = add_diffuse(scene, "light", Rgb(0.78f));
  scene.materials.back().emission = {17, 12, 4};
  scene.materials.back().double_sided = false;

  add_quads(scene, "floor", white, {{Vec3(kWidth, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, kDepth), Vec3(549.6f, 0, kDepth)}});
  add_quads(scene, "ceiling", white,
            {{Vec3(556, kHeight, 0), Vec3(556, kHeight, kDepth), Vec3(0, kHeight, kDepth), Vec3(0, kHeight, 0)}});
  add_quads(scene, "back wall", white,
            {{Vec3(549.6f, 0, kDepth), Vec3(0, 0, kDepth), Vec3(0, kHeight, kDepth), Vec3(556, kHeight, kDepth)}});
  add_quads(scene, "right wall", green,
            {{Vec3(0, 0, kDepth), Vec3(0, 0, 0), Vec3(0, kHeight, 0), Vec3(0, kHeight, kDepth)}});
  add_quads(scene, "left wall", red,
            {{Vec3(kWidth, 0, 0), Vec3(549.6f, 0, kDepth), Vec3(556, kHeight, kDepth), Vec3(556, kHeight, 0)}});
  // 0.1 published units below the ceiling, so that the two surfaces do not coincide.
  constexpr float kLight = kHeight - 0.1f;
  add_quads(scene, "light", light,
            {{Vec3(343, kLight, 227), Vec3(343, kLight, 332), Vec3(213, kLight, 332), Vec3(213, kLight, 227)}});
  return scene;
}

inline void add_camera(Scene& scene) {
  // Focal length 35 mm, film size 25 mm.
  Camera camera = look_at(kMetres * Vec3(278, 273, -800), kMetres * Vec3(278, 273, 0), Vec3(0, 1, 0),
                          2 * std::atan(0.5f * 25 / 35));
  camera.aspect = 1;
  add(scene, camera);
}

}  // namespace cornell

inline Scene cornell_box() {
  using namespace cornell;
  Scene scene = room("Cornell box");
  const int short_box = add_diffuse(scene, "short box", {0.725f, 0.71f, 0.68f}),
            tall_box = add_diffuse(scene, "tall box", {0.725f, 0.71f, 0.68f});
  add_quads(scene, "short box", short_box,
            block({Vec3(130, 165, 65), Vec3(82, 165, 225), Vec3(240, 165, 272), Vec3(290, 165, 114)}));
  add_quads(scene, "tall box", tall_box,
            block({Vec3(423, 330, 247), Vec3(265, 330, 296), Vec3(314, 330, 456), Vec3(472, 330, 406)}));
  add_camera(scene);
  return scene;
}

inline constexpr Builtin kCornell{
    .name = "cornell",
    .label = "Cornell box",
    .doc = "A diffuse room with one area light: every integrator should converge quickly",
    .make = cornell_box,
};

}  // namespace etendue::scene
