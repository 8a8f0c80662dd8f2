// A glass of milk, which shows nested media: milk overlaps the wall of the glass.
#pragma once
#include "medium/medium_presets.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/lathe.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {
namespace milk {

// Metres.
inline constexpr float kRadius = 0.035f, kWall = 0.002f, kBase = 0.006f, kHeight = 0.1f, kLevel = 0.075f;

// The outer and the inner surface of the glass.
inline std::shared_ptr<const Mesh> glass_body() {
  const Vec2 up(0, 1), down(0, -1), out(1, 0), in(-1, 0);
  constexpr float kInner = kRadius - kWall;
  const OutlinePoint outline[] = {{{0, 0}, down},           {{kRadius, 0}, down},      {{kRadius, 0}, out},
                                  {{kRadius, kHeight}, out}, {{kRadius, kHeight}, up}, {{kInner, kHeight}, up},
                                  {{kInner, kHeight}, in},  {{kInner, kBase}, in},     {{kInner, kBase}, up},
                                  {{0, kBase}, up}};
  return lathe(outline, 64);
}

// Extends into the wall and the base by half of their thickness.
inline std::shared_ptr<const Mesh> body() {
  const Vec2 up(0, 1), down(0, -1), out(1, 0);
  constexpr float kSide = kRadius - 0.5f * kWall, kBottom = 0.5f * kBase;
  const OutlinePoint outline[] = {{{0, kBottom}, down},   {{kSide, kBottom}, down}, {{kSide, kBottom}, out},
                                  {{kSide, kLevel}, out}, {{kSide, kLevel}, up},    {{0, kLevel}, up}};
  return lathe(outline, 64);
}

}  // namespace milk

inline Scene glass_of_milk() {
  Scene scene;
  scene.name = "Glass of milk";
  add(scene, "table", rectangle({-0.4f, 0, 0.4f}, {0.8f, 0, 0}, {0, 0, -0.8f}),
      add_diffuse(scene, "table", {0.35f, 0.2f, 0.12f}));
  add(scene, "wall", rectangle({-0.4f, 0, -0.3f}, {0.8f, 0, 0}, {0, 0.6f, 0}),
      add_diffuse(scene, "wall", {0.3f, 0.4f, 0.5f}));
  constexpr float kLift = 0.0005f;  // above the table, so that no surfaces touch
  Material glass_material = glass(1.5f);
  glass_material.medium_priority = 1;  // the wall of the glass stays glass where the milk overlaps it
  add(scene, "glass", milk::glass_body(), add_material(scene, "glass", glass_material), translated({0, kLift, 0}));
  Material liquid = glass(1.34f);
  liquid.medium = find_medium_preset("skim-milk")->medium;
  add(scene, "milk", milk::body(), add_material(scene, "milk", liquid), translated({0, kLift, 0}));
  add(scene, "light", rectangle({-0.3f, 0.5f, -0.1f}, {0.4f, 0, 0}, {0, 0, 0.4f}),
      add_emitter(scene, "light", Rgb(9, 8.5f, 8)));

  Camera camera = look_at({0.02f, 0.16f, 0.3f}, {0, 0.048f, 0}, {0, 1, 0}, 0.5f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kMilk{
    .name = "milk",
    .label = "Glass of milk",
    .doc = "Skim milk in a glass: light is scattered dozens of times before it leaves the liquid",
    .make = glass_of_milk,
};

}  // namespace etendue::scene
