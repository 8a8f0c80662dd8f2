// Imports nodes and the roots of a scene.                                                      glTF 2.0, section 3.5
#include <algorithm>

#include "scene/gltf/import/importers.h"
#include "scene/pose.h"

namespace etendue::scene::gltf {
namespace {

constexpr double kRounding = 1e-6;

Vec3 vec3_of(const std::vector<double>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

std::vector<float> floats_of(const std::vector<double>& v) {
  std::vector<float> floats;
  for (const double x : v) floats.push_back(static_cast<float>(x));
  return floats;
}

class NodeImporter {
 public:
  NodeImporter(const InputFile& input, Scene& scene) : input_(input), scene_(scene) {}

  void run(int scene_index) {
    for (size_t i = 0; i < input_.model.nodes.size(); ++i)
      scene_.nodes.push_back(import(input_.model.nodes[i], at("nodes", i)));
    for (size_t i = 0; i < scene_.nodes.size(); ++i)
      for (const int child : scene_.nodes[i].children)
        scene_.nodes[static_cast<size_t>(child)].parent = static_cast<int>(i);
    choose_roots(scene_index);
  }

 private:
  void warn(const std::string& where, const std::string& what) { scene_.warnings.push_back(where + ": " + what); }

  Node import(const tinygltf::Node& from, const std::string& where) {
    Node node;
    node.name = from.name;
    node.transform = transform(from, where);
    node.children = from.children;
    node.mesh = from.mesh;
    node.camera = from.camera;
    node.skin = from.skin;
    node.weights = floats_of(from.weights);
    if (node.skin >= 0 && node.mesh < 0) {
      warn(where, "has a skin but no mesh; the skin is ignored");
      node.skin = -1;
    }
    if (const auto* extension = find_extension(from.extensions, "KHR_lights_punctual"))
      node.light = static_cast<int>(checked_index(index_or(*extension, "light", -1), input_.model.lights.size(),
                                                  where + ".extensions.KHR_lights_punctual.light", "lights"));
    if (const auto* extension = find_extension(from.extensions, "KHR_node_visibility"))
      if (extension->Get("visible").IsBool()) node.visible = extension->Get("visible").Get<bool>();
    node.portal = import_portal(from.extensions, where, scene_.warnings);
    const bool is_rendered = node.mesh >= 0 && node.skin < 0;
    if (is_rendered && is_singular(node.transform.to_matrix()))
      warn(where, "the transform is singular, as with a scale of 0; the mesh is not rendered");
    return node;
  }

  Transform transform(const tinygltf::Node& from, const std::string& where) {
    Transform t;
    if (!from.matrix.empty()) {
      Mat4 m;
      for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = static_cast<float>(from.matrix[static_cast<size_t>(i)]);
      if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1) {
        warn(where + ".matrix", "the last row has to be 0 0 0 1; it was replaced");
        m[0][3] = m[1][3] = m[2][3] = 0;
        m[3][3] = 1;
      }
      t.matrix = m;
    }
    if (!from.translation.empty()) t.translation = vec3_of(from.translation);
    if (from.scale.size() == 2) fail(where + ".scale", "has 2 numbers; it has to have 3");
    if (!from.scale.empty()) t.scale = vec3_of(from.scale);
    if (!from.rotation.empty()) t.rotation = rotation(from.rotation, where);
    return t;
  }

  Vec4 rotation(const std::vector<double>& q, const std::string& where) {
    const glm::dvec4 exact(q[0], q[1], q[2], q[3]);
    const double length = glm::length(exact);
    if (!(length > 0) || !std::isfinite(length)) {
      warn(where + ".rotation", "is not a quaternion that can be normalised; it is ignored");
      return Vec4(0, 0, 0, 1);
    }
    if (std::abs(length - 1) > 1e-2) warn(where + ".rotation", "is not a unit quaternion; it was normalised");
    // Within rounding of unit length, the value of the file is kept bit for bit.
    return Vec4(std::abs(length - 1) <= kRounding ? exact : exact / length);
  }

  void choose_roots(int scene_index) {
    const auto& scenes = input_.model.scenes;
    for (size_t s = 0; s < scenes.size(); ++s)
      scene_.scene_names.push_back(scenes[s].name.empty() ? "scene " + std::to_string(s) : scenes[s].name);
    if (scene_index >= 0 && static_cast<size_t>(scene_index) >= scenes.size())
      throw FileError{"scene " + std::to_string(scene_index) + " does not exist; the file has " +
                      std::to_string(scenes.size())};
    if (scenes.empty()) {
      if (!scene_.nodes.empty()) scene_.warnings.emplace_back("the file has no scenes; all nodes are shown");
      for (size_t i = 0; i < scene_.nodes.size(); ++i)
        if (scene_.nodes[i].parent < 0) scene_.roots.push_back(static_cast<int>(i));
      return;
    }
    const auto chosen = static_cast<size_t>(scene_index >= 0 ? scene_index : std::max(input_.model.defaultScene, 0));
    if (!scenes[chosen].name.empty()) scene_.name = scenes[chosen].name;
    std::vector<bool> listed(scene_.nodes.size(), false);
    for (const int root : scenes[chosen].nodes) {
      const auto i = static_cast<size_t>(root);
      const std::string where = at("scenes", chosen) + ".nodes";
      if (scene_.nodes[i].parent >= 0)
        warn(where, "nodes[" + std::to_string(root) + "] is not a root; it is shown without its parent");
      if (listed[i]) warn(where, "nodes[" + std::to_string(root) + "] is listed twice; it is shown once");
      if (!listed[i]) scene_.roots.push_back(root);
      listed[i] = true;
    }
    drop_nested_roots();
  }

  // Removes roots that are descendants of other roots; they would be shown twice.
  void drop_nested_roots() {
    std::vector<bool> below(scene_.nodes.size(), false);
    std::vector<int> stack;
    for (const int root : scene_.roots) {
      const auto& children = scene_.nodes[static_cast<size_t>(root)].children;
      stack.insert(stack.end(), children.begin(), children.end());
    }
    while (!stack.empty()) {
      const auto i = static_cast<size_t>(stack.back());
      stack.pop_back();
      if (below[i]) continue;
      below[i] = true;
      stack.insert(stack.end(), scene_.nodes[i].children.begin(), scene_.nodes[i].children.end());
    }
    std::erase_if(scene_.roots, [&](int root) { return below[static_cast<size_t>(root)]; });
  }

  const InputFile& input_;
  Scene& scene_;
};

}  // namespace

void import_nodes(const InputFile& input, Scene& scene, int scene_index) {
  NodeImporter(input, scene).run(scene_index);
}

}  // namespace etendue::scene::gltf
