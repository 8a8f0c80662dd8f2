// A room lit by one spot light in an uplighter: a bright patch on the ceiling lights the rest of the room. After
// [Lang, fig. 9.17].
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/lathe.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {
namespace spot {

inline constexpr Vec3 kLight{1.55f, 1.55f, -1.35f};  // position of the spot light, metres

inline void add_uplighter(Scene& scene) {
  const int metal = add_metal(scene, "brushed steel", Rgb(0.6f), 0.35f);
  const Vec2 up(0, 1), out(1, 0);
  const OutlinePoint stand[] = {{{0, 0}, -up},          {{0.17f, 0}, -up},      {{0.17f, 0}, out},
                                {{0.17f, 0.03f}, out},  {{0.17f, 0.03f}, up},   {{0.015f, 0.03f}, up},
                                {{0.015f, 0.03f}, out}, {{0.015f, 1.38f}, out}, {{0.015f, 1.38f}, up},
                                {{0, 1.38f}, up}};
  add(scene, "stand", lathe(stand, 48), metal, translated({kLight.x, 0, kLight.z}));
  // A bowl around the light, open at the top.
  const Vec2 flare(0.3f, -0.14f);
  const OutlinePoint shade[] = {
      {{0, -0.16f}, -up}, {{0.06f, -0.16f}, -up}, {{0.06f, -0.16f}, flare}, {{0.2f, 0.14f}, flare}};
  add(scene, "shade", lathe(shade, 64), add_diffuse(scene, "shade", Rgb(0.3f)), translated(kLight));
}

inline void add_table(Scene& scene) {
  const int wood = add_diffuse(scene, "wood", {0.5f, 0.32f, 0.18f});
  const Vec3 middle(-0.25f, 0.62f, -0.3f);
  const Vec2 up(0, 1), out(1, 0);
  const OutlinePoint top[] = {{{0, -0.04f}, -up}, {{0.75f, -0.04f}, -up}, {{0.75f, -0.04f}, out},
                              {{0.75f, 0}, out},  {{0.75f, 0}, up},       {{0, 0}, up}};
  add(scene, "table top", lathe(top, 96), wood, translated(middle));
  add_box(scene, "table leg", wood, {middle.x - 0.06f, 0, middle.z - 0.06f},
          {middle.x + 0.06f, 0.6f, middle.z + 0.06f});
  constexpr float kLift = 0.001f;  // above the table, so that no surfaces touch
  add(scene, "glass egg", egg(0.17f, 0.18f, 0.27f, 56), add_glass(scene, "glass", 1.5f),
      translated(middle + Vec3(-0.15f, 0.18f + kLift, 0.1f)));
  add(scene, "china ball", ball(0.13f, 40), add_diffuse(scene, "china", {0.2f, 0.3f, 0.6f}),
      translated(middle + Vec3(0.32f, 0.13f + kLift, -0.15f)));
}

}  // namespace spot

inline Scene spot_indirect() {
  Scene scene;
  scene.name = "Indirect spotlight";
  const int white = add_diffuse(scene, "white", Rgb(0.78f)), floor = add_diffuse(scene, "floor", {0.5f, 0.42f, 0.33f}),
            green = add_diffuse(scene, "green wall", {0.35f, 0.55f, 0.35f}),
            warm = add_diffuse(scene, "warm wall", {0.75f, 0.5f, 0.35f});
  add_room(scene, {-2, 0, -2}, {2.2f, 2.7f, 3.4f},
           {.floor = floor, .ceiling = white, .back = white, .front = white, .left = green, .right = warm});
  spot::add_uplighter(scene);
  spot::add_table(scene);
  Light light = make_light("spot", {{"intensity", 140.0}, {"inner-cone", 0.3}, {"outer-cone", 0.5}});
  light.color = {1, 0.9f, 0.75f};
  add(scene, "spot light", light, look_at(spot::kLight, spot::kLight + Vec3(-0.1f, 1, 0.1f), {0, 0, 1}, 1).to_world);

  Camera camera = look_at({-0.3f, 1.35f, 3.2f}, {0.1f, 0.85f, -0.5f}, {0, 1, 0}, 0.75f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kSpotIndirect{
    .name = "spot-indirect",
    .label = "Indirect spotlight",
    .doc =
        "One small bright patch on the ceiling lights the room: light paths reach it directly, camera paths only by "
        "chance",
    .make = spot_indirect,
};

}  // namespace etendue::scene
