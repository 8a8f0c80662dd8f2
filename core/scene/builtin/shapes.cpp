#include "scene/builtin/shapes.h"

#include <cmath>

namespace etendue::scene {
namespace {

void add_quad(Mesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d, bool flip) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
  if (flip) {
    mesh.triangles.push_back({first, first + 2, first + 1});
    mesh.triangles.push_back({first, first + 3, first + 2});
  } else {
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
}

}  // namespace

std::shared_ptr<const Mesh> padded(Mesh mesh) {
  mesh.positions.reserve(mesh.positions.size() + 1);
  return std::make_shared<const Mesh>(std::move(mesh));
}

Material diffuse(const Rgb& albedo, const Rgb& emission) {
  Material m;
  m.base_color = albedo;
  m.metallic = 0;
  m.specular = 0;
  m.emission = emission;
  m.double_sided = true;
  return m;
}

Material glass(float ior) {
  Material m;
  m.name = "glass";
  m.metallic = 0;
  m.roughness = 0;
  m.transmission = 1;
  m.thickness = 1;
  m.ior = ior;
  return m;
}

std::shared_ptr<const Mesh> cube(float s, bool inwards) { return box(Vec3(s), inwards); }

std::shared_ptr<const Mesh> box(const Vec3& half, bool inwards) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    for (const float side : {-half[axis], half[axis]}) {
      const auto corner = [&](float u, float v) {
        Vec3 p;
        p[axis] = side;
        p[next] = u * half[next];
        p[last] = v * half[last];
        return p;
      };
      add_quad(mesh, corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1), (side < 0) != inwards);
    }
  }
  return padded(std::move(mesh));
}

std::shared_ptr<const Mesh> rectangle(const Vec3& corner, const Vec3& u, const Vec3& v) {
  Mesh mesh;
  add_quad(mesh, corner, corner + u, corner + u + v, corner + v, false);
  return padded(std::move(mesh));
}

std::shared_ptr<const Mesh> quad(float s) {
  Mesh mesh;
  add_quad(mesh, {-s, 0, s}, {s, 0, s}, {s, 0, -s}, {-s, 0, -s}, false);
  mesh.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return padded(std::move(mesh));
}

std::shared_ptr<const Mesh> disk(float radius, int segments) {
  Mesh mesh;
  // The polygon is slightly larger than an inscribed one, so that it has the area of the disk.
  const float step = 2 * kPi / static_cast<float>(segments);
  const float r = radius * std::sqrt(step / std::sin(step));
  mesh.positions.push_back(Vec3(0));
  for (int i = 0; i < segments; ++i) {
    const float phi = step * static_cast<float>(i);
    mesh.positions.emplace_back(r * std::cos(phi), 0, -r * std::sin(phi));
    mesh.triangles.push_back({0, static_cast<uint32_t>(1 + i), static_cast<uint32_t>(1 + (i + 1) % segments)});
  }
  return padded(std::move(mesh));
}

std::shared_ptr<const Mesh> sphere(float radius, int rings, bool inwards) {
  Mesh mesh;
  const int segments = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < segments; ++j) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(rings);
      const float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(segments);
      mesh.positions.push_back(radius *
                               Vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)));
    }
  const auto at = [&](int i, int j) { return static_cast<uint32_t>(i * segments + j % segments); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < segments; ++j) {
      Triangle upper{at(i, j), at(i, j + 1), at(i + 1, j)}, lower{at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)};
      if (inwards) {
        std::swap(upper[1], upper[2]);
        std::swap(lower[1], lower[2]);
      }
      if (i > 0) mesh.triangles.push_back(upper);
      if (i + 1 < rings) mesh.triangles.push_back(lower);
    }
  return padded(std::move(mesh));
}

int add(Scene& scene, std::shared_ptr<const Mesh> mesh, const Material& material, const Mat4& transform) {
  scene.materials.push_back(material);
  Primitive primitive;
  primitive.mesh = std::move(mesh);
  primitive.material = static_cast<int>(scene.materials.size()) - 1;
  scene.meshes.push_back({"", {primitive}, {}});
  Node node;
  node.mesh = static_cast<int>(scene.meshes.size()) - 1;
  node.transform.matrix = transform;
  scene.nodes.push_back(node);
  scene.roots.push_back(static_cast<int>(scene.nodes.size()) - 1);
  return scene.roots.back();
}

int add(Scene& scene, const Light& light, const Transform& transform) {
  scene.lights.push_back(light);
  Node node;
  node.light = static_cast<int>(scene.lights.size()) - 1;
  node.transform = transform;
  scene.nodes.push_back(node);
  scene.roots.push_back(static_cast<int>(scene.nodes.size()) - 1);
  return scene.roots.back();
}

int add_point_light(Scene& scene, const Vec3& position, float intensity) {
  const Light light = make_light("point", {{"intensity", double{intensity}}});
  Transform transform;
  transform.translation = position;
  return add(scene, light, transform);
}

Scene furnace(float albedo) {
  Scene scene;
  add(scene, cube(1, true), diffuse(Rgb(albedo), Rgb(1)));
  return scene;
}

}  // namespace etendue::scene
