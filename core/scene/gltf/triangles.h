// The triangles of a primitive, whatever mode it has.                                       glTF 2.0, section 3.7.2.1
#pragma once
#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "scene/gltf/document.h"

namespace etendue::scene::gltf {

// Strips and fans as lists that face the same way. Empty for points and lines. Corners are below `vertices`; an index
// that is not is unusable.
std::vector<Triangle> read_triangles(const Document& document, const tinygltf::Primitive& primitive, size_t vertices,
                                     const std::string& where, std::vector<std::string>& warnings);

// Renumbers the corners so that no vertex is left out, and returns the vertices to take, in their old order. Empty if
// all vertices are used.
std::vector<uint32_t> compact(std::vector<Triangle>& triangles, size_t vertices);

}  // namespace etendue::scene::gltf
