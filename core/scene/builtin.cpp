// The Cornell box: corners in millimetres and reflectances as published by the Cornell University Program of Computer
// Graphics.
#include "scene/builtin.h"

#include "scene/gltf.h"

namespace etendue::scene {
namespace {

// One published unit is a millimetre; scaled by ten the box is a room of 5.6 m.
constexpr float kMetres = 0.01f;

using Corners = std::array<Vec3, 4>;

// Corners as published: counter-clockwise as seen from where the surface is lit.
constexpr float kWidth = 552.8f, kDepth = 559.2f, kHeight = 548.8f;

std::shared_ptr<const Mesh> mesh_of(const std::string& name, const std::vector<Corners>& quads) {
  auto mesh = std::make_shared<Mesh>();
  mesh->name = name;
  mesh->positions.reserve(quads.size() * 4 + 1);
  for (const Corners& corners : quads) {
    const auto first = static_cast<uint32_t>(mesh->positions.size());
    for (const Vec3& corner : corners) mesh->positions.push_back(corner * kMetres);
    mesh->triangles.push_back({first, first + 1, first + 2});
    mesh->triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

Material lambertian(const char* name, const Rgb& albedo) {
  Material m;
  m.name = name;
  m.base_color = albedo;
  m.metallic = 0;
  m.specular = 0;
  m.double_sided = true;
  return m;
}

void add(Scene& scene, const char* name, int material, const std::vector<Corners>& quads) {
  Primitive primitive;
  primitive.mesh = mesh_of(name, quads);
  primitive.material = material;
  scene.meshes.push_back({name, {primitive}, {}});
  Node node;
  node.name = name;
  node.mesh = static_cast<int>(scene.meshes.size()) - 1;
  scene.nodes.push_back(node);
  scene.roots.push_back(static_cast<int>(scene.nodes.size()) - 1);
}

// A block on the floor from the four corners of its top, in either sense of rotation: every face is turned outwards.
std::vector<Corners> block(const Corners& top) {
  std::vector<Corners> quads{top};
  const Vec3 middle = 0.25f * (top[0] + top[1] + top[2] + top[3]);
  for (size_t i = 0; i < 4; ++i) {
    const Vec3 a = top[i], b = top[(i + 1) % 4];
    Corners side{a, Vec3(a.x, 0, a.z), Vec3(b.x, 0, b.z), b};
    const Vec3 normal = glm::cross(side[1] - side[0], side[2] - side[0]);
    if (glm::dot(normal, a + b - 2.0f * middle) < 0) side = {b, Vec3(b.x, 0, b.z), Vec3(a.x, 0, a.z), a};
    quads.push_back(side);
  }
  const Vec3 up = glm::cross(top[1] - top[0], top[2] - top[0]);
  if (up.y < 0) quads[0] = {top[3], top[2], top[1], top[0]};
  return quads;
}

}  // namespace

Scene cornell_box() {
  Scene scene;
  scene.name = "Cornell box";
  // The measured spectra under the light's, as linear Rec. 709.
  scene.materials = {lambertian("white", {0.725f, 0.71f, 0.68f}),     lambertian("red", {0.63f, 0.065f, 0.05f}),
                     lambertian("green", {0.14f, 0.45f, 0.091f}),     lambertian("light", Rgb(0.78f)),
                     lambertian("short box", {0.725f, 0.71f, 0.68f}), lambertian("tall box", {0.725f, 0.71f, 0.68f})};
  scene.materials[3].emission = {17, 12, 4};
  scene.materials[3].double_sided = false;

  add(scene, "floor", 0, {{Vec3(kWidth, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, kDepth), Vec3(549.6f, 0, kDepth)}});
  add(scene, "ceiling", 0,
      {{Vec3(556, kHeight, 0), Vec3(556, kHeight, kDepth), Vec3(0, kHeight, kDepth), Vec3(0, kHeight, 0)}});
  add(scene, "back wall", 0,
      {{Vec3(549.6f, 0, kDepth), Vec3(0, 0, kDepth), Vec3(0, kHeight, kDepth), Vec3(556, kHeight, kDepth)}});
  add(scene, "right wall", 2, {{Vec3(0, 0, kDepth), Vec3(0, 0, 0), Vec3(0, kHeight, 0), Vec3(0, kHeight, kDepth)}});
  add(scene, "left wall", 1,
      {{Vec3(kWidth, 0, 0), Vec3(549.6f, 0, kDepth), Vec3(556, kHeight, kDepth), Vec3(556, kHeight, 0)}});
  // A tenth of a millimetre under the ceiling, whose surface it covers.
  constexpr float kLight = kHeight - 0.1f;
  add(scene, "light", 3,
      {{Vec3(343, kLight, 227), Vec3(343, kLight, 332), Vec3(213, kLight, 332), Vec3(213, kLight, 227)}});
  add(scene, "short box", 4, block({Vec3(130, 165, 65), Vec3(82, 165, 225), Vec3(240, 165, 272), Vec3(290, 165, 114)}));
  add(scene, "tall box", 5,
      block({Vec3(423, 330, 247), Vec3(265, 330, 296), Vec3(314, 330, 456), Vec3(472, 330, 406)}));

  // 35 mm behind a film of 25 mm.
  Camera camera = look_at(kMetres * Vec3(278, 273, -800), kMetres * Vec3(278, 273, 0), Vec3(0, 1, 0),
                          2 * std::atan(0.5f * 25 / 35));
  camera.name = "camera";
  camera.aspect = 1;
  Node node;
  node.name = "camera";
  node.transform.matrix = camera.to_world;
  camera.to_world = Mat4(1);
  node.camera = 0;
  scene.cameras.push_back(camera);
  scene.nodes.push_back(node);
  scene.roots.push_back(static_cast<int>(scene.nodes.size()) - 1);
  return scene;
}

Result<Scene> load(const std::string& file_or_name) {
  if (file_or_name == "cornell") return cornell_box();
  return load_gltf(file_or_name);
}

}  // namespace etendue::scene
