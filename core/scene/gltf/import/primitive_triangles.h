// The triangles of a primitive in any topology.                                            glTF 2.0, section 3.7.2.1
#pragma once
#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "scene/gltf/import/input_file.h"

namespace etendue::scene::gltf {

// Strips and fans become lists with the same orientation. Empty for points and lines, with a warning. Throws FileError
// if an index is not below `vertices`.
std::vector<Triangle> read_triangles(const InputFile& input, const tinygltf::Primitive& primitive, size_t vertices,
                                     const std::string& where, std::vector<std::string>& warnings);

// Renumbers the corners so that every vertex is used. Returns the used vertices in their old order; empty if all are
// used.
std::vector<uint32_t> compact_vertices(std::vector<Triangle>& triangles, size_t vertices);

}  // namespace etendue::scene::gltf
