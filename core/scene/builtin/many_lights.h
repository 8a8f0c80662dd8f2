// A hall of open rooms with a thousand small coloured lamps: each lights what is near it and nothing else, so that
// choosing lamps by their power alone asks the wrong ones.
#pragma once
#include "base/hash.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/stage.h"

namespace etendue::scene {
namespace many {

inline constexpr int kRooms = 8;  // along either side
inline constexpr float kRoom = 4, kSide = kRooms * kRoom, kHeight = 2;

// A number of its own for each lamp and purpose.
inline float chance(int lamp, uint32_t purpose) {
  return to_unit_float(hash_combine(mix_bits(static_cast<uint32_t>(lamp) + 1), purpose));
}

// A square that hangs somewhere in the hall and shines down, more or less: the camera sees the backs of all.
inline void add_square(Mesh& mesh, int lamp, float size) {
  const float tilt = 0.25f * chance(lamp, 0), turn = 2 * kPi * chance(lamp, 1);
  const Vec3 down(std::sin(tilt) * std::cos(turn), -std::cos(tilt), std::sin(tilt) * std::sin(turn));
  const Vec3 u = size * glm::normalize(glm::cross(down, Vec3(1, 0, 0))), v = glm::cross(down, u);
  const Vec3 corner = Vec3(chance(lamp, 2), 0, chance(lamp, 3)) * kSide + Vec3(0, 0.5f + chance(lamp, 4), 0);
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (const Vec3& p : {corner, corner + u, corner + u + v, corner + v}) mesh.positions.push_back(p);
  mesh.triangles.push_back({first, first + 1, first + 2}), mesh.triangles.push_back({first, first + 2, first + 3});
}

inline void add_lamps(Scene& scene, int count) {
  struct Color {
    const char* name;
    Rgb hue;
  };
  static const Color kColors[] = {{"red lamps", {1, 0.25f, 0.15f}},  {"amber lamps", {1, 0.7f, 0.25f}},
                                  {"green lamps", {0.3f, 1, 0.35f}}, {"teal lamps", {0.2f, 0.9f, 1}},
                                  {"blue lamps", {0.35f, 0.45f, 1}}, {"white lamps", {1, 0.95f, 0.85f}}};
  constexpr int kKinds = std::size(kColors);
  // However many there are, they are as large together.
  constexpr float kArea = 5;
  const float size = std::sqrt(kArea / static_cast<float>(count));
  for (int kind = 0; kind < std::min(kKinds, count); ++kind) {
    auto mesh = std::make_shared<Mesh>();
    mesh->positions.reserve(static_cast<size_t>(4 * (count / kKinds + 1) + 1));
    for (int lamp = kind; lamp < count; lamp += kKinds) add_square(*mesh, lamp, size);
    const Color& color = kColors[kind];
    add(scene, color.name, mesh, add_lamp(scene, color.name, 120.0f * color.hue));
  }
}

// Walls with a gap in the middle of every room's side.
inline void add_walls(Scene& scene, int paint) {
  constexpr float kHalf = 0.05f, kDoor = 1.2f, kPiece = kRoom - kDoor;
  for (int wall = 1; wall < kRooms; ++wall)
    for (int piece = 0; piece <= kRooms; ++piece) {
      const float at = kRoom * static_cast<float>(wall), along = kRoom * static_cast<float>(piece);
      const float from = std::max(along - kPiece / 2, 0.0f), to = std::min(along + kPiece / 2, kSide);
      add_box(scene, "wall", paint, {from, 0, at - kHalf}, {to, kHeight, at + kHalf});
      // Lower by a little, so that no two surfaces are one where walls cross.
      add_box(scene, "wall across", paint, {at - kHalf, 0, from}, {at + kHalf, kHeight - 0.01f, to});
    }
}

}  // namespace many

// With so many lamps.
inline Scene hall_of_lights(int count) {
  using namespace many;
  Scene scene;
  scene.name = "Many lights";
  const int floor = add_paint(scene, "floor", {0.6f, 0.6f, 0.6f}),
            wall = add_paint(scene, "wall", {0.7f, 0.68f, 0.64f});
  add(scene, "floor", rectangle({0, 0, 0}, {0, 0, kSide}, {kSide, 0, 0}), floor);
  add_walls(scene, wall);
  add_lamps(scene, count);
  Camera camera = look_at({kSide / 2, 13, kSide + 6}, {kSide / 2, 0, kSide / 2 + 3}, {0, 1, 0}, 0.65f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline Scene many_lights() { return hall_of_lights(1000); }

inline constexpr Builtin kManyLights{
    "many-lights", "A thousand lamps",
    "Lamps that light only what is near them: choosing by power asks the wrong ones, a tree of lights the right ones",
    many_lights};

}  // namespace etendue::scene
