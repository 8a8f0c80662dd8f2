#include "scene/builtin/scene_builder.h"

namespace etendue::scene {
namespace {

Node& add_root(Scene& scene, const char* name) {
  Node node;
  node.name = name;
  scene.nodes.push_back(node);
  scene.roots.push_back(static_cast<int>(scene.nodes.size()) - 1);
  return scene.nodes.back();
}

}  // namespace

int add_material(Scene& scene, const char* name, Material material) {
  material.name = name;
  scene.materials.push_back(std::move(material));
  return static_cast<int>(scene.materials.size()) - 1;
}

int add_diffuse(Scene& scene, const char* name, const Rgb& albedo) {
  return add_material(scene, name, diffuse(albedo));
}

int add_emitter(Scene& scene, const char* name, const Rgb& radiance) {
  Material emitter = diffuse(Rgb(0), radiance);
  emitter.double_sided = false;
  return add_material(scene, name, emitter);
}

int add_metal(Scene& scene, const char* name, const Rgb& color, float roughness) {
  Material metal;
  metal.base_color = color;
  metal.roughness = roughness;
  return add_material(scene, name, metal);
}

int add_glass(Scene& scene, const char* name, float ior) { return add_material(scene, name, glass(ior)); }

Node& add(Scene& scene, const char* name, std::shared_ptr<const Mesh> mesh, int material, const Transform& transform) {
  Primitive primitive;
  primitive.mesh = std::move(mesh);
  primitive.material = material;
  scene.meshes.push_back({name, {primitive}, {}});
  Node& node = add_root(scene, name);
  node.mesh = static_cast<int>(scene.meshes.size()) - 1;
  node.transform = transform;
  return node;
}

Node& add(Scene& scene, const char* name, const Light& light, const Mat4& to_world) {
  scene.lights.push_back(light);
  scene.lights.back().name = name;
  Node& node = add_root(scene, name);
  node.light = static_cast<int>(scene.lights.size()) - 1;
  node.transform.matrix = to_world;
  return node;
}

void add(Scene& scene, Camera camera) {
  camera.name = "camera";
  Node& node = add_root(scene, "camera");
  node.transform.matrix = std::exchange(camera.to_world, Mat4(1));
  node.camera = static_cast<int>(scene.cameras.size());
  scene.cameras.push_back(camera);
}

Node& add_box(Scene& scene, const char* name, int material, const Vec3& lower, const Vec3& upper) {
  return add(scene, name, box(0.5f * (upper - lower)), material, translated(0.5f * (upper + lower)));
}

void add_room(Scene& scene, const Vec3& lower, const Vec3& upper, const RoomMaterials& materials) {
  const Vec3 size = upper - lower, x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  add(scene, "floor", rectangle(lower, z, x), materials.floor);
  add(scene, "ceiling", rectangle(upper, -x, -z), materials.ceiling);
  add(scene, "back wall", rectangle(lower, x, y), materials.back);
  add(scene, "front wall", rectangle(upper, -y, -x), materials.front);
  add(scene, "left wall", rectangle(lower, y, z), materials.left);
  add(scene, "right wall", rectangle(upper, -z, -y), materials.right);
}

Transform rotated_x(const Vec3& translation, float angle) {
  return {.translation = translation, .rotation = {std::sin(angle / 2), 0, 0, std::cos(angle / 2)}};
}

Transform rotated_y(const Vec3& translation, float angle) {
  return {.translation = translation, .rotation = {0, std::sin(angle / 2), 0, std::cos(angle / 2)}};
}

}  // namespace etendue::scene
