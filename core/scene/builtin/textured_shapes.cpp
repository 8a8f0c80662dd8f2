#include "scene/builtin/textured_shapes.h"

#include <cmath>

#include "scene/builtin/shapes.h"

namespace etendue::scene {
namespace {

constexpr int kSphereRings = 48, kSphereSegments = 96, kDiskSegments = 96;

// A rectangle with the whole texture. `right` and `up` are half of its sides.
void add_face(Mesh& mesh, const Vec3& centre, const Vec3& right, const Vec3& up) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(),
                        {centre - right - up, centre + right - up, centre + right + up, centre - right + up});
  mesh.uvs[0].insert(mesh.uvs[0].end(), {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

std::shared_ptr<const Mesh> textured_plane() {
  Mesh mesh;
  add_face(mesh, Vec3(0), {1, 0, 0}, {0, 0, -1});
  return padded(std::move(mesh));
}

std::shared_ptr<const Mesh> textured_box() {
  Mesh mesh;
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  add_face(mesh, x, -z, y);
  add_face(mesh, -x, z, y);
  add_face(mesh, y, x, -z);
  add_face(mesh, -y, x, z);
  add_face(mesh, z, x, y);
  add_face(mesh, -z, -x, y);
  return padded(std::move(mesh));
}

std::shared_ptr<const Mesh> textured_disk() {
  Mesh mesh = *disk(1, kDiskSegments);
  for (const Vec3& p : mesh.positions) mesh.uvs[0].emplace_back(0.5f + 0.5f * p.x, 0.5f + 0.5f * p.z);
  return padded(std::move(mesh));
}

// Vertices of row `ring`. The first and the last one are at the same place, with u = 1 and u = 0. At the poles, each triangle
// has its own vertex, in the middle of its range of u.
void add_ring(Mesh& mesh, int ring) {
  const float theta = kPi * static_cast<float>(ring) / kSphereRings;
  const bool is_pole = ring == 0 || ring == kSphereRings;
  const float sine = is_pole ? 0 : std::sin(theta);
  for (int j = 0; j <= kSphereSegments; ++j) {
    const float phi = 2 * kPi * static_cast<float>(j % kSphereSegments) / kSphereSegments;
    const Vec3 p(sine * std::cos(phi), std::cos(theta), sine * std::sin(phi));
    mesh.positions.push_back(p);
    mesh.normals.push_back(glm::normalize(p));
    const float u = (static_cast<float>(j) + (is_pole ? 0.5f : 0.0f)) / kSphereSegments;
    mesh.uvs[0].emplace_back(1 - u, static_cast<float>(ring) / kSphereRings);
  }
}

std::shared_ptr<const Mesh> textured_sphere() {
  Mesh mesh;
  for (int ring = 0; ring <= kSphereRings; ++ring) add_ring(mesh, ring);
  const auto at = [](int i, int j) { return static_cast<uint32_t>(i * (kSphereSegments + 1) + j); };
  for (int i = 0; i < kSphereRings; ++i)
    for (int j = 0; j < kSphereSegments; ++j) {
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      // At the north pole, the vertex of this triangle is the one with index j.
      const uint32_t upper = at(i, i > 0 ? j + 1 : j);
      if (i + 1 < kSphereRings) mesh.triangles.push_back({upper, at(i + 1, j + 1), at(i + 1, j)});
    }
  return padded(std::move(mesh));
}

}  // namespace

std::shared_ptr<const Mesh> textured_shape(std::string_view name) {
  if (name == "sphere") return textured_sphere();
  if (name == "plane") return textured_plane();
  if (name == "box") return textured_box();
  if (name == "disk") return textured_disk();
  return nullptr;
}

}  // namespace etendue::scene
