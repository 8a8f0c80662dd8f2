// Putting raw triangles in order before they are traced: what has no area, stands there twice or is no number.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/mesh.h"

namespace etendue {

// Removes triangles with a corner that is not finite and moves such vertices onto one that is. Returns how many were
// removed.
size_t drop_non_finite(Mesh& mesh);

// Removes triangles whose normal is lost in rounding: two corners in one place, all three on a line, or areas beyond
// what a float holds. Returns how many.
size_t drop_degenerate(Mesh& mesh);

// Removes triangles that lie exactly on an earlier one with the same front: they would emit and absorb twice. Returns
// how many.
size_t drop_duplicates(Mesh& mesh);

// Makes all normals unit vectors. One that has no direction becomes the mean of the faces around it. Returns how many
// had none.
size_t repair_normals(Mesh& mesh);

// Three vertices for every triangle, with its geometric normal. Returns of which vertex each is a copy.
std::vector<uint32_t> split_into_flat_triangles(Mesh& mesh);

// Appends copies of these vertices, in all arrays that the mesh has.
void append_copies(Mesh& mesh, const std::vector<uint32_t>& vertices);

// Equal positions have equal hashes; zero has no sign here.
uint64_t hash_position(const Vec3& p);

}  // namespace etendue
