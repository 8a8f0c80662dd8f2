// EXT_mesh_gpu_instancing: a node for each instance, below the node that lists them. The mesh stays one.
#include "scene/gltf/accessor.h"
#include "scene/gltf/import.h"

namespace etendue::scene::gltf {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

class InstanceReader {
 public:
  InstanceReader(const Document& document, const tinygltf::Node& node, std::string where)
      : document_(document), attributes_(extension_of(node.extensions, kInstancing)), where_(std::move(where)) {}

  std::vector<Transform> run() {
    const auto translations = read<Vec3>("TRANSLATION", Use::vectors, read_vec3);
    const auto rotations = read<Vec4>("ROTATION", Use::rotations, read_vec4);
    const auto scales = read<Vec3>("SCALE", Use::vectors, read_vec3);
    claim(document_, count_ * sizeof(Node), where_);
    std::vector<Transform> instances(count_);
    for (size_t i = 0; i < count_; ++i) {
      if (!translations.empty()) instances[i].translation = translations[i];
      if (!rotations.empty()) instances[i].rotation = unit(rotations[i]);
      if (!scales.empty()) instances[i].scale = scales[i];
    }
    return instances;
  }

 private:
  template <class V, class Read>
  std::vector<V> read(const char* name, Use use, Read&& reader) {
    const int accessor = index_of(attributes_->Get("attributes"), name, -1);
    if (accessor < 0) return {};
    count_ = count_of(document_, accessor);
    return reader(document_, accessor, use, nullptr, where_ + ".attributes." + name);
  }

  static Vec4 unit(const Vec4& q) {
    const float length = glm::length(q);
    constexpr float kNearlyOne = 1e-6f;
    if (std::abs(length - 1) <= kNearlyOne) return q;
    return length > 0 && std::isfinite(length) ? q / length : Vec4(0, 0, 0, 1);
  }

  const Document& document_;
  const tinygltf::Value* attributes_;
  std::string where_;
  size_t count_ = 0;
};

}  // namespace

void import_instances(const Document& document, Scene& scene) {
  for (size_t n = 0; n < document.model.nodes.size(); ++n) {
    if (!extension_of(document.model.nodes[n].extensions, kInstancing)) continue;
    const std::string where = at("nodes", n) + ".extensions." + kInstancing;
    if (scene.nodes[n].mesh < 0 || scene.nodes[n].skin >= 0) {
      scene.warnings.push_back(where + ": only a node with a mesh and no skin has instances; it is ignored");
      continue;
    }
    Node instance;
    instance.parent = static_cast<int>(n);
    instance.mesh = std::exchange(scene.nodes[n].mesh, -1), instance.weights = scene.nodes[n].weights;
    for (const Transform& transform : InstanceReader(document, document.model.nodes[n], where).run()) {
      instance.transform = transform;
      scene.nodes[n].children.push_back(static_cast<int>(scene.nodes.size()));
      scene.nodes.push_back(instance);
    }
  }
}

}  // namespace etendue::scene::gltf
