// Tangents for normal maps, for meshes without tangents                      [Mikkelsen 2008; glTF 2.0, sec. 3.7.2.1]
//
// As glTF requires, triangle corners share a tangent if they agree in position, normal and texture coordinates, are
// connected by edges and have the same handedness. The tangent is the mean of the tangents of their triangles, weighted
// by angle. A vertex on the seam of a mirrored texture needs two tangents and is split.
#pragma once
#include <vector>

#include "geometry/mesh.h"

namespace etendue {

// Computes mesh.tangents from the normals and the texture coordinates of this set, which the mesh must have.
// `to_texture` is the linear part of the texture transform. Appends copies of the vertices that must be split, and
// returns the index of the original of each copy.
std::vector<uint32_t> generate_tangents(Mesh& mesh, size_t set, const glm::mat2& to_texture = glm::mat2(1));

}  // namespace etendue
