// A room lit by one spot light that shines upwards out of a floor lamp: a bright patch on the ceiling lights the rest
// (thesis, figure 9.17: floor lamp, table, glass egg).
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/lathe.h"
#include "scene/builtin/stage.h"

namespace etendue::scene {
namespace spot {

inline constexpr Vec3 kLamp{1.55f, 1.55f, -1.35f};  // where the spot light is

inline void add_floor_lamp(Scene& scene) {
  const int metal = add_metal(scene, "brushed steel", Rgb(0.6f), 0.35f);
  const Vec2 up(0, 1), out(1, 0);
  const OutlinePoint stand[] = {{{0, 0}, -up},          {{0.17f, 0}, -up},      {{0.17f, 0}, out},
                                {{0.17f, 0.03f}, out},  {{0.17f, 0.03f}, up},   {{0.015f, 0.03f}, up},
                                {{0.015f, 0.03f}, out}, {{0.015f, 1.38f}, out}, {{0.015f, 1.38f}, up},
                                {{0, 1.38f}, up}};
  add(scene, "stand", lathe(stand, 48), metal, moved({kLamp.x, 0, kLamp.z}));
  // A bowl around the light, open above.
  const Vec2 flare(0.3f, -0.14f);
  const OutlinePoint shade[] = {
      {{0, -0.16f}, -up}, {{0.06f, -0.16f}, -up}, {{0.06f, -0.16f}, flare}, {{0.2f, 0.14f}, flare}};
  add(scene, "shade", lathe(shade, 64), add_paint(scene, "shade", Rgb(0.3f)), moved(kLamp));
}

inline void add_table(Scene& scene) {
  const int wood = add_paint(scene, "wood", {0.5f, 0.32f, 0.18f});
  const Vec3 middle(-0.25f, 0.62f, -0.3f);
  const Vec2 up(0, 1), out(1, 0);
  const OutlinePoint top[] = {{{0, -0.04f}, -up}, {{0.75f, -0.04f}, -up}, {{0.75f, -0.04f}, out},
                              {{0.75f, 0}, out},  {{0.75f, 0}, up},       {{0, 0}, up}};
  add(scene, "table top", lathe(top, 96), wood, moved(middle));
  add_box(scene, "table leg", wood, {middle.x - 0.06f, 0, middle.z - 0.06f},
          {middle.x + 0.06f, 0.6f, middle.z + 0.06f});
  constexpr float kLift = 0.001f;  // off the table, so that no surfaces touch
  add(scene, "glass egg", egg(0.17f, 0.18f, 0.27f, 56), add_glass(scene, "glass", 1.5f),
      moved(middle + Vec3(-0.15f, 0.18f + kLift, 0.1f)));
  add(scene, "china ball", ball(0.13f, 40), add_paint(scene, "china", {0.2f, 0.3f, 0.6f}),
      moved(middle + Vec3(0.32f, 0.13f + kLift, -0.15f)));
}

}  // namespace spot

inline Scene spot_indirect() {
  Scene scene;
  scene.name = "Indirect light of a spot";
  const int white = add_paint(scene, "white", Rgb(0.78f)), floor = add_paint(scene, "floor", {0.5f, 0.42f, 0.33f}),
            green = add_paint(scene, "green wall", {0.35f, 0.55f, 0.35f}),
            warm = add_paint(scene, "warm wall", {0.75f, 0.5f, 0.35f});
  add_room(scene, {-2, 0, -2}, {2.2f, 2.7f, 3.4f},
           {.floor = floor, .ceiling = white, .back = white, .front = white, .left = green, .right = warm});
  spot::add_floor_lamp(scene);
  spot::add_table(scene);
  Light light = make_light("spot", {{"intensity", 140.0}, {"inner-cone", 0.3}, {"outer-cone", 0.5}});
  light.color = {1, 0.9f, 0.75f};
  add(scene, "spot light", light, look_at(spot::kLamp, spot::kLamp + Vec3(-0.1f, 1, 0.1f), {0, 0, 1}, 1).to_world);

  Camera camera = look_at({-0.3f, 1.35f, 3.2f}, {0.1f, 0.85f, -0.5f}, {0, 1, 0}, 0.75f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kSpotIndirect{
    "spot-indirect", "Indirect light of a spot lamp",
    "One small bright patch lights the room: walks from the lamp know where it is, walks from the camera look for it",
    spot_indirect};

}  // namespace etendue::scene
