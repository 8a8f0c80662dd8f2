// A room that receives light only through the gap of a door. The light in the next room is behind the open door leaf,
// so no surface in this room is lit directly. After the scene of [Veach and Guibas 1997], with different dimensions.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/lathe.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {
namespace ajar {

// The wall between the rooms is 0.1 m thick. The doorway extends in x from kHinge to kJamb and is kTop high (metres).
inline constexpr float kHinge = 0.6f, kJamb = 1.5f, kTop = 2.05f, kWall = -0.1f;

inline void add_door(Scene& scene, int wall) {
  // The walls extend by kInto into floor, ceiling and walls, so that no light leaks.
  constexpr float kInto = 0.05f, kLeft = -2.2f, kRight = 2.6f, kHeight = 2.6f;
  add_box(scene, "wall left of the door", wall, {kLeft - kInto, -kInto, kWall}, {kHinge, kHeight + kInto, 0});
  add_box(scene, "wall right of the door", wall, {kJamb, -kInto, kWall}, {kRight + kInto, kHeight + kInto, 0});
  add_box(scene, "wall over the door", wall, {kHinge - kInto, kTop, kWall}, {kJamb + kInto, kHeight + kInto, 0});
  // The leaf opens into the next room. When closed, it overlaps the edges of the doorway.
  constexpr float kAngle = 0.35f, kWidth = kJamb - kHinge, kOverlap = 0.02f, kThickness = 0.04f;
  const Vec3 along(std::cos(kAngle), 0, -std::sin(kAngle)), into(-std::sin(kAngle), 0, -std::cos(kAngle));
  const Vec3 middle = Vec3(kHinge, 0.5f * kTop, kWall) + along * (0.5f * kWidth) + into * (0.5f * kThickness);
  add(scene, "door", box({0.5f * kWidth + kOverlap, 0.5f * kTop + kInto, 0.5f * kThickness}),
      add_diffuse(scene, "door", {0.5f, 0.32f, 0.18f}), rotated_y(middle, kAngle));
}

inline std::shared_ptr<const Mesh> jug() {
  constexpr Vec2 kOutline[] = {{0, 0},         {0.09f, 0.005f}, {0.14f, 0.06f}, {0.15f, 0.13f}, {0.11f, 0.21f},
                               {0.07f, 0.25f}, {0.085f, 0.3f},  {0.06f, 0.3f},  {0.05f, 0.25f}, {0, 0.22f}};
  return lathe(smooth_outline(kOutline, 8), 96);
}

inline void add_table(Scene& scene) {
  const int wood = add_diffuse(scene, "wood", {0.45f, 0.27f, 0.14f});
  const Vec3 middle(-0.1f, 0.7f, 2.1f);
  add_box(scene, "table top", wood, middle + Vec3(-0.65f, -0.04f, -0.4f), middle + Vec3(0.65f, 0, 0.4f));
  for (const float x : {-0.58f, 0.52f})
    for (const float z : {-0.35f, 0.29f})
      add_box(scene, "table leg", wood, middle + Vec3(x, -0.7f, z), middle + Vec3(x + 0.06f, -0.02f, z + 0.06f));
  constexpr float kLift = 0.001f;  // above the table, so that no surfaces touch
  add(scene, "jug", jug(), add_diffuse(scene, "clay", {0.7f, 0.4f, 0.28f}), translated(middle + Vec3(-0.4f, kLift, 0)));
  add(scene, "glass egg", egg(0.12f, 0.13f, 0.19f, 48), add_glass(scene, "glass", 1.5f),
      translated(middle + Vec3(0.02f, 0.13f + kLift, 0.12f)));
  add(scene, "copper ball", ball(0.14f, 40), add_metal(scene, "copper", {0.93f, 0.62f, 0.5f}, 0.3f),
      translated(middle + Vec3(0.42f, 0.14f + kLift, -0.05f)));
}

}  // namespace ajar

inline Scene door_ajar() {
  Scene scene;
  scene.name = "Door ajar";
  const int wall = add_diffuse(scene, "wall", {0.7f, 0.68f, 0.63f}),
            floor = add_diffuse(scene, "floor", {0.5f, 0.4f, 0.3f}),
            blue = add_diffuse(scene, "blue wall", {0.35f, 0.45f, 0.65f});
  add_room(scene, {-2.2f, 0, -3}, {2.6f, 2.6f, 4.2f},
           {.floor = floor, .ceiling = wall, .back = wall, .front = wall, .left = blue, .right = wall});
  ajar::add_door(scene, wall);
  ajar::add_table(scene);
  // Lower than the doorway, so that no light passes over the top of the leaf.
  add(scene, "light", ball(0.15f, 16), add_emitter(scene, "light", Rgb(6000, 5400, 4500)),
      translated({-0.9f, 1.4f, -1.8f}));

  Camera camera = look_at({0.8f, 1.5f, 4.1f}, {0.1f, 0.85f, 0}, {0, 1, 0}, 0.8f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kDoorAjar{
    .name = "door-ajar",
    .label = "Door ajar",
    .doc =
        "All light enters through a narrow gap after at least one bounce in the next room: favours integrators that "
        "reuse successful paths",
    .make = door_ajar,
};

}  // namespace etendue::scene
