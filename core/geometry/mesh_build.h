// Validation and repair of triangle meshes: non-finite, degenerate and duplicate triangles, normals.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/mesh.h"

namespace etendue {

// Removes triangles with a non-finite vertex and moves such vertices to a finite one. Returns the number of triangles
// removed.
size_t drop_non_finite(Mesh& mesh);

// Removes triangles whose normal cannot be computed: two equal vertices, collinear vertices up to rounding, or an area
// that overflows. Returns the number of triangles removed.
size_t drop_degenerate(Mesh& mesh);

// Removes triangles with the vertices and the orientation of an earlier one, because coincident triangles would emit
// and absorb twice. Returns the number of triangles removed.
size_t drop_duplicates(Mesh& mesh);

// Normalises all normals. A normal without direction is replaced by the area-weighted mean of the adjacent faces.
// Returns the number of normals replaced.
size_t repair_normals(Mesh& mesh);

// Replaces shared vertices by three vertices per triangle with its geometric normal, for flat shading. Returns for each
// new vertex the index of the vertex that it copies.
std::vector<uint32_t> split_into_flat_triangles(Mesh& mesh);

// Appends copies of these vertices to all arrays of the mesh.
void append_copies(Mesh& mesh, const std::vector<uint32_t>& vertices);

// Equal positions have equal hashes; 0 and -0 are equal.
uint64_t hash_position(const Vec3& p);

}  // namespace etendue
