// A hall of open rooms with a thousand small coloured lights. Each illuminates only its neighbourhood, so that
// selection of lights by power alone mostly chooses lights that do not contribute.
#pragma once
#include "base/hash.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {
namespace many {

inline constexpr int kRooms = 8;  // along either side
inline constexpr float kRoom = 4, kSide = kRooms * kRoom, kHeight = 2;

// A random number in [0, 1) for each light and purpose.
inline float random_unit(int light, uint32_t purpose) {
  return to_unit_float(hash_combine(mix_bits(static_cast<uint32_t>(light) + 1), purpose));
}

// A square at a random place in the hall that emits downwards, tilted by up to 0.25 rad. The camera sees only backs.
inline void add_square(Mesh& mesh, int light, float size) {
  const float tilt = 0.25f * random_unit(light, 0), turn = 2 * kPi * random_unit(light, 1);
  const Vec3 down(std::sin(tilt) * std::cos(turn), -std::cos(tilt), std::sin(tilt) * std::sin(turn));
  const Vec3 u = size * glm::normalize(glm::cross(down, Vec3(1, 0, 0))), v = glm::cross(down, u);
  const Vec3 corner =
      Vec3(random_unit(light, 2), 0, random_unit(light, 3)) * kSide + Vec3(0, 0.5f + random_unit(light, 4), 0);
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (const Vec3& p : {corner, corner + u, corner + u + v, corner + v}) mesh.positions.push_back(p);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

inline void add_lights(Scene& scene, int count) {
  struct Color {
    const char* name;
    Rgb hue;
  };
  static const Color kColors[] = {{"red lights", {1, 0.25f, 0.15f}},  {"amber lights", {1, 0.7f, 0.25f}},
                                  {"green lights", {0.3f, 1, 0.35f}}, {"teal lights", {0.2f, 0.9f, 1}},
                                  {"blue lights", {0.35f, 0.45f, 1}}, {"white lights", {1, 0.95f, 0.85f}}};
  constexpr int kKinds = std::size(kColors);
  // Total area in m^2, independent of the number of lights.
  constexpr float kArea = 5;
  const float size = std::sqrt(kArea / static_cast<float>(count));
  for (int kind = 0; kind < std::min(kKinds, count); ++kind) {
    auto mesh = std::make_shared<Mesh>();
    mesh->positions.reserve(static_cast<size_t>(4 * (count / kKinds + 1) + 1));
    for (int light = kind; light < count; light += kKinds) add_square(*mesh, light, size);
    const Color& color = kColors[kind];
    add(scene, color.name, mesh, add_emitter(scene, color.name, 120.0f * color.hue));
  }
}

// Walls with a gap in the middle of each side of a room.
inline void add_walls(Scene& scene, int paint) {
  constexpr float kHalf = 0.05f, kDoor = 1.2f, kPiece = kRoom - kDoor;
  for (int wall = 1; wall < kRooms; ++wall)
    for (int piece = 0; piece <= kRooms; ++piece) {
      const float position = kRoom * static_cast<float>(wall), along = kRoom * static_cast<float>(piece);
      const float from = std::max(along - kPiece / 2, 0.0f), to = std::min(along + kPiece / 2, kSide);
      add_box(scene, "wall", paint, {from, 0, position - kHalf}, {to, kHeight, position + kHalf});
      // Slightly lower, so that the tops of crossing walls do not coincide.
      add_box(scene, "wall across", paint, {position - kHalf, 0, from}, {position + kHalf, kHeight - 0.01f, to});
    }
}

}  // namespace many

// The scene with any number of lights.
inline Scene hall_of_lights(int count) {
  using namespace many;
  Scene scene;
  scene.name = "Many lights";
  const int floor = add_diffuse(scene, "floor", {0.6f, 0.6f, 0.6f}),
            wall = add_diffuse(scene, "wall", {0.7f, 0.68f, 0.64f});
  add(scene, "floor", rectangle({0, 0, 0}, {0, 0, kSide}, {kSide, 0, 0}), floor);
  add_walls(scene, wall);
  add_lights(scene, count);
  Camera camera = look_at({kSide / 2, 13, kSide + 6}, {kSide / 2, 0, kSide / 2 + 3}, {0, 1, 0}, 0.65f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline Scene many_lights() { return hall_of_lights(1000); }

inline constexpr Builtin kManyLights{
    .name = "many-lights",
    .label = "A thousand lights",
    .doc =
        "Each light illuminates only its neighbourhood: a light tree chooses the lights that matter, selection by "
        "power does not",
    .make = many_lights,
};

}  // namespace etendue::scene
