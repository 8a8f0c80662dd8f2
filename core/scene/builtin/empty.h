// A scene without objects, to which the user adds some.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_builder.h"
#include "scene/builtin/shapes.h"

namespace etendue::scene {

inline Scene empty_scene() {
  Scene scene;
  scene.name = "New scene";
  scene.materials.push_back(diffuse(Rgb(0.7f)));
  // Looks at the origin from the front and above, with room for objects of about a metre.
  Camera camera = look_at(Vec3(0.9f, 1.2f, 3), Vec3(0, 0.2f, 0), Vec3(0, 1, 0), 0.7f);
  camera.name = "camera";
  add(scene, camera);
  return scene;
}

// Opened as "new". Not in the list of built-in scenes, which are there to be rendered.
inline constexpr Builtin kEmpty{
    .name = kNewScene,
    .label = "New scene",
    .doc = "An empty scene in studio light, to which shapes, lights and cameras are added",
    .make = empty_scene,
};

}  // namespace etendue::scene
