// Decompresses geometry into plain buffers, buffer views and accessors, before the rest of the importer reads the file.
//                                                              KHR_draco_mesh_compression, EXT_meshopt_compression
#pragma once
#include <functional>
#include <nlohmann/json.hpp>

#include "scene/gltf/import/input_file.h"

namespace etendue::scene::gltf {

// Preconditions: the JSON has passed check_structure and the buffers of the file are open. Data that the file also
// holds uncompressed are left alone. Throws FileError; Cancelled if `progress` returns false.
void decompress(nlohmann::json& root, InputFile& input, const std::function<bool(float)>& progress);

}  // namespace etendue::scene::gltf
