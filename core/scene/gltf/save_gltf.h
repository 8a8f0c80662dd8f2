// Writes glTF 2.0: .glb, or .gltf with a .bin file and PNG images next to it.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace etendue::scene {

// Writes the whole scene. Buffers and images are written before the file that refers to them, and each file is replaced
// atomically. What glTF does not describe goes into the extension ETENDUE_transport
// (docs/ETENDUE_transport.schema.json); files that do not need it do not use it. Errors (Fault::output) name the cause.
// `warnings` receives one line for each property that could not be stored.
Result<void> save_gltf(const Scene& scene, const std::filesystem::path& path,
                       std::vector<std::string>* warnings = nullptr);

}  // namespace etendue::scene
