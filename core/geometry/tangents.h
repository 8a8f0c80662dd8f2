// Tangents for normal maps where a file has none.                  M. Mikkelsen, "MikkTSpace", 2008; glTF 2.0,
// section 3.7.2.1
//
// As glTF asks for: corners of triangles that agree in position, normal and texture coordinates, are joined by edges
// and have the same handedness share a tangent, which is the mean of theirs weighted by angle. A vertex on the seam of
// a mirrored texture gets two tangents, so it is split.
#pragma once
#include <vector>

#include "geometry/mesh.h"

namespace etendue {

// Fills mesh.tangents from normals and texture coordinates of the given set, which the mesh must have. `to_texture` is
// what the texture does to the coordinates. Appends the vertices that have to be split and says of which vertex each is
// a copy.
std::vector<uint32_t> generate_tangents(Mesh& mesh, size_t set, const glm::mat2& to_texture = glm::mat2(1));

}  // namespace etendue
