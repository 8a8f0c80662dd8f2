#include "geometry/tangents.h"

namespace etendue {
namespace {

float angle_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(glm::dot(normalize_or(a, Vec3(1, 0, 0)), normalize_or(b, Vec3(1, 0, 0))), -1.0f, 1.0f));
}

}  // namespace

std::vector<Vec4> generate_tangents(const Mesh& mesh, size_t set) {
  const size_t n = mesh.positions.size();
  std::vector<Vec3> along_u(n, Vec3(0)), along_v(n, Vec3(0)), normals(n, Vec3(0));
  for (const Triangle& t : mesh.triangles) {
    const Vec3 e1 = mesh.positions[t[1]] - mesh.positions[t[0]], e2 = mesh.positions[t[2]] - mesh.positions[t[0]];
    const Vec2 d1 = mesh.uvs[set][t[1]] - mesh.uvs[set][t[0]], d2 = mesh.uvs[set][t[2]] - mesh.uvs[set][t[0]];
    const float area = d1.x * d2.y - d1.y * d2.x;
    const float sign = area < 0 ? -1.0f : 1.0f;
    const Vec3 u = normalize_or((e1 * d2.y - e2 * d1.y) * sign, Vec3(0)), v = normalize_or((e2 * d1.x - e1 * d2.x) * sign, Vec3(0));
    const Vec3 normal = normalize_or(glm::cross(e1, e2), Vec3(0));
    const float weights[3] = {angle_between(e1, e2), angle_between(-e1, e2 - e1), angle_between(-e2, e1 - e2)};
    for (size_t k = 0; k < 3; ++k) {
      along_u[t[k]] += u * weights[k];
      along_v[t[k]] += v * weights[k];
      normals[t[k]] += normal * weights[k];
    }
  }
  std::vector<Vec4> tangents(n);
  for (size_t i = 0; i < n; ++i) {
    const Vec3 normal = mesh.normals.empty() ? normalize_or(normals[i], Vec3(0, 0, 1)) : mesh.normals[i];
    const Vec3 any = std::abs(normal.x) < 0.9f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 tangent = normalize_or(along_u[i] - normal * glm::dot(normal, along_u[i]), glm::normalize(glm::cross(normal, any)));
    // v grows downwards in the picture, but the bitangent follows it as it stands in the file.
    const float handedness = glm::dot(glm::cross(normal, tangent), along_v[i]) < 0 ? -1.0f : 1.0f;
    tangents[i] = Vec4(tangent, handedness);
  }
  return tangents;
}

}  // namespace etendue
