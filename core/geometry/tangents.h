// Tangents for normal maps where a file has none.                                       glTF 2.0, section 3.7.2.1
//
// Per vertex, from the gradients of the texture coordinates over its triangles, weighted by their angles as MikkTSpace does;
// vertices are not split where the handedness changes (the majority wins), which MikkTSpace would do.
#pragma once
#include <vector>

#include "geometry/mesh.h"

namespace etendue {

// One a vertex; `set` is the set of texture coordinates, which the mesh must have. Without normals geometric ones are used.
std::vector<Vec4> generate_tangents(const Mesh& mesh, size_t set);

}  // namespace etendue
