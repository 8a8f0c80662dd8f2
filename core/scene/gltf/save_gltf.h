// glTF 2.0 out: .glb, or .gltf with a .bin and pictures beside it.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace etendue::scene {

// Writes all of the scene; the file that names the others comes last, and each is replaced in one step. What glTF has
// no words for goes into the extension ETENDUE_transport (docs/ETENDUE_transport.schema.json), which files without such
// things do not get. Errors (Fault::output) say what stood in the way. `warnings` gets what was lost, one line each.
Result<void> save_gltf(const Scene& scene, const std::filesystem::path& path,
                       std::vector<std::string>* warnings = nullptr);

}  // namespace etendue::scene
