// Texture coordinates and vertex colours at a point of a triangle.
#pragma once
#include "geometry/mesh.h"
#include "material/surface_material.h"

namespace etendue::scene {

// u and v are the barycentric weights of vertices 1 and 2.
inline TexturePoint texture_point(const Mesh& mesh, uint32_t triangle, float u, float v) {
  const Triangle& t = mesh.triangles[triangle];
  const float w = 1 - u - v;
  TexturePoint point;
  for (size_t set = 0; set < 2; ++set)
    if (const auto& uvs = mesh.uvs[set]; !uvs.empty()) point.uv[set] = uvs[t[0]] * w + uvs[t[1]] * u + uvs[t[2]] * v;
  if (!mesh.colors.empty()) point.color = mesh.colors[t[0]] * w + mesh.colors[t[1]] * u + mesh.colors[t[2]] * v;
  return point;
}

}  // namespace etendue::scene
