// Four plates from nearly polished to rough, each tilted so that it reflects a row of spherical lights of increasing
// size and equal power. After the scene of [Veach and Guibas 1995] for multiple importance sampling, with different
// dimensions.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/lathe.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {

inline Scene glossy_plates() {
  Scene scene;
  scene.name = "Glossy plates";
  const int grey = add_diffuse(scene, "grey", Rgb(0.4f));
  add(scene, "floor", rectangle({-8, -0.6f, 8}, {16, 0, 0}, {0, 0, -11}), grey);
  add(scene, "wall", rectangle({-8, -0.6f, -3}, {16, 0, 0}, {0, 10, 0}), grey);

  const Vec3 eye(0, 1.5f, 7), row(0, 2.9f, -0.7f);
  struct Plate {
    const char* name;
    float roughness;
    Vec3 middle;
  };
  for (const Plate& p :
       {Plate{"roughness 0.07", 0.07f, {0, 1.35f, -1.1f}}, Plate{"roughness 0.14", 0.14f, {0, 0.8f, -0.5f}},
        Plate{"roughness 0.22", 0.22f, {0, 0.3f, 0.3f}}, Plate{"roughness 0.32", 0.32f, {0, -0.15f, 1.3f}}}) {
    const Vec3 normal = glm::normalize(eye - p.middle) + glm::normalize(row - p.middle);
    const int metal = add_metal(scene, p.name, Rgb(0.75f), p.roughness);
    add(scene, p.name, box({2.1f, 0.01f, 0.3f}), metal, rotated_x(p.middle, std::atan2(normal.z, normal.y)));
  }

  struct SphereLight {
    const char* name;
    float x, radius;
    Rgb tint;
  };
  for (const SphereLight& l : {SphereLight{"tiny light", -1.65f, 0.03f, {1, 0.75f, 0.5f}},
                               SphereLight{"small light", -0.65f, 0.09f, {1, 0.95f, 0.6f}},
                               SphereLight{"middle light", 0.45f, 0.21f, {0.6f, 1, 0.7f}},
                               SphereLight{"large light", 1.65f, 0.42f, {0.6f, 0.75f, 1}}}) {
    const int emitter = add_emitter(scene, l.name, 0.35f / sqr(l.radius) * l.tint);
    add(scene, l.name, ball(l.radius, 16), emitter, translated(row + Vec3(l.x, 0, 0)));
  }

  Camera camera = look_at(eye, {0, 1.25f, 0}, {0, 1, 0}, 0.6f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kGlossyPlates{
    .name = "glossy-plates",
    .label = "Glossy plates (Veach MIS)",
    .doc =
        "Light sampling fails on smooth plates under large lights, BSDF sampling on rough plates under small lights; "
        "multiple importance sampling handles both",
    .make = glossy_plates,
};

}  // namespace etendue::scene
