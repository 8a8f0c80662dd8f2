// Compressed geometry: made into plain buffers, views and accessors before anything else looks at the file.
//                                                              KHR_draco_mesh_compression, EXT_meshopt_compression
#pragma once
#include <functional>
#include <nlohmann/json.hpp>

#include "scene/gltf/document.h"

namespace etendue::scene::gltf {

// The JSON has passed check_structure and the document has its buffers. What also lies there uncompressed is left
// alone. Throws Unusable; Cancelled if `progress` says so.
void decompress(nlohmann::json& root, Document& document, const std::function<bool(float)>& progress);

}  // namespace etendue::scene::gltf
