// Reads glTF 2.0: .gltf, .glb and data URIs.                     Khronos glTF 2.0 specification and the KHR extensions
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "base/result.h"
#include "scene/scene.h"

namespace etendue::scene {

struct LoadOptions {
  int scene = -1;  // index of the glTF scene; -1 is the default scene of the file
  // Called from the loading thread with the name of the phase and its finished fraction; returning false cancels.
  std::function<bool(const char* phase, float done)> progress;
  // Called once from a loading thread when the scene is complete apart from the images of its textures, which other
  // threads are reading. Not called for scenes without images.
  std::function<void(const Scene&)> without_images;
};

// Errors (Fault::input) name the file, the JSON path of the object ("meshes[3].primitives[0]") and what would be right.
// What can be repaired is repaired, with a line in Scene::warnings.
Result<Scene> load_gltf(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace etendue::scene
