#include "scene/builtin/stage.h"

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

int add_paint(Scene& scene, const char* name, const Rgb& albedo) { return add_material(scene, name, diffuse(albedo)); }

int add_lamp(Scene& scene, const char* name, const Rgb& radiance) {
  Material lamp = diffuse(Rgb(0), radiance);
  lamp.double_sided = false;
  return add_material(scene, name, lamp);
}

int add_metal(Scene& scene, const char* name, const Rgb& color, float roughness) {
  Material metal;
  metal.base_color = color, metal.roughness = roughness;
  return add_material(scene, name, metal);
}

int add_glass(Scene& scene, const char* name, float ior) { return add_material(scene, name, glass(ior)); }

Node& add(Scene& scene, const char* name, std::shared_ptr<const Mesh> mesh, int material, const Transform& place) {
  Primitive primitive;
  primitive.mesh = std::move(mesh);
  primitive.material = material;
  scene.meshes.push_back({name, {primitive}, {}});
  Node& node = add_root(scene, name);
  node.mesh = static_cast<int>(scene.meshes.size()) - 1;
  node.transform = place;
  return node;
}

Node& add(Scene& scene, const char* name, const Light& light, const Mat4& place) {
  scene.lights.push_back(light);
  scene.lights.back().name = name;
  Node& node = add_root(scene, name);
  node.light = static_cast<int>(scene.lights.size()) - 1;
  node.transform.matrix = place;
  return node;
}

void add(Scene& scene, Camera camera) {
  camera.name = "camera";
  Node& node = add_root(scene, "camera");
  node.transform.matrix = std::exchange(camera.to_world, Mat4(1));
  node.camera = static_cast<int>(scene.cameras.size());
  scene.cameras.push_back(camera);
}

Node& add_box(Scene& scene, const char* name, int material, const Vec3& least, const Vec3& most) {
  return add(scene, name, box(0.5f * (most - least)), material, moved(0.5f * (most + least)));
}

void add_room(Scene& scene, const Vec3& least, const Vec3& most, const Paints& paints) {
  const Vec3 size = most - least, x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  add(scene, "floor", rectangle(least, z, x), paints.floor);
  add(scene, "ceiling", rectangle(most, -x, -z), paints.ceiling);
  add(scene, "back wall", rectangle(least, x, y), paints.back);
  add(scene, "front wall", rectangle(most, -y, -x), paints.front);
  add(scene, "left wall", rectangle(least, y, z), paints.left);
  add(scene, "right wall", rectangle(most, -z, -y), paints.right);
}

Transform tipped(const Vec3& to, float angle) {
  return {.translation = to, .rotation = {std::sin(angle / 2), 0, 0, std::cos(angle / 2)}};
}

Transform turned(const Vec3& to, float angle) {
  return {.translation = to, .rotation = {0, std::sin(angle / 2), 0, std::cos(angle / 2)}};
}

}  // namespace etendue::scene
