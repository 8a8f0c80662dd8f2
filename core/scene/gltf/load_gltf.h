// glTF 2.0 in: .gltf, .glb, data URIs.                           Khronos glTF 2.0 specification and the KHR extensions
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "base/result.h"
#include "scene/scene.h"

namespace etendue::scene {

struct LoadOptions {
  int scene = -1;                                               // index of the glTF scene, -1 for the file's default
  std::function<bool(const char* phase, float done)> progress;  // false cancels; called from the loading thread
};

// Errors (Fault::input) name the file, the object (as "meshes[3].primitives[0]") and what would be right. What can be
// repaired is, with a line in Scene::warnings.
Result<Scene> load_gltf(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace etendue::scene
