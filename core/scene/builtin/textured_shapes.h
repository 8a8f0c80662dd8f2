// Shapes that users add to a scene: with texture coordinates, and with normals where the surface is curved.
//
// Textures appear upright and are not mirrored: v increases downwards, as in glTF. All shapes extend from -1 to 1.
#pragma once
#include <memory>
#include <string_view>

#include "geometry/mesh.h"

namespace etendue::scene {

// The mesh of a shape, null for another name:
//   sphere  u along the equator, v from the north pole (+y) to the south pole
//   plane   in the xz plane, facing +y; the whole texture
//   box     the whole texture on each face
//   disk    in the xz plane, facing +y; the circle inscribed in the texture. It has the area of the disk, so that its
//           coordinates exceed [0, 1] by 0.1 %
std::shared_ptr<const Mesh> textured_shape(std::string_view name);

}  // namespace etendue::scene
