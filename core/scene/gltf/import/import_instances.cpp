// Imports EXT_mesh_gpu_instancing: each instance becomes a child of its node. All share one mesh.
#include "scene/gltf/import/accessor.h"
#include "scene/gltf/import/importers.h"

namespace etendue::scene::gltf {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

class InstanceReader {
 public:
  InstanceReader(const InputFile& input, const tinygltf::Node& node, std::string where)
      : input_(input), attributes_(find_extension(node.extensions, kInstancing)), where_(std::move(where)) {}

  std::vector<Transform> run() {
    const auto translations = read<Vec3>("TRANSLATION", AccessorUse::vectors, read_vec3);
    const auto rotations = read<Vec4>("ROTATION", AccessorUse::rotations, read_vec4);
    const auto scales = read<Vec3>("SCALE", AccessorUse::vectors, read_vec3);
    check_memory(input_, count_ * sizeof(Node), where_);
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
  std::vector<V> read(const char* name, AccessorUse use, Read&& reader) {
    const int accessor = index_or(attributes_->Get("attributes"), name, -1);
    if (accessor < 0) return {};
    count_ = count_of(input_, accessor);
    return reader(input_, accessor, use, nullptr, where_ + ".attributes." + name);
  }

  static Vec4 unit(const Vec4& q) {
    const float length = glm::length(q);
    constexpr float kRounding = 1e-6f;
    if (std::abs(length - 1) <= kRounding) return q;
    return length > 0 && std::isfinite(length) ? q / length : Vec4(0, 0, 0, 1);
  }

  const InputFile& input_;
  const tinygltf::Value* attributes_;
  std::string where_;
  size_t count_ = 0;
};

}  // namespace

void import_instances(const InputFile& input, Scene& scene) {
  for (size_t n = 0; n < input.model.nodes.size(); ++n) {
    if (!find_extension(input.model.nodes[n].extensions, kInstancing)) continue;
    const std::string where = at("nodes", n) + ".extensions." + kInstancing;
    if (scene.nodes[n].mesh < 0 || scene.nodes[n].skin >= 0) {
      scene.warnings.push_back(where + ": the node has to have a mesh and no skin; the instances are ignored");
      continue;
    }
    Node instance;
    instance.parent = static_cast<int>(n);
    instance.mesh = std::exchange(scene.nodes[n].mesh, -1);
    instance.weights = scene.nodes[n].weights;
    for (const Transform& transform : InstanceReader(input, input.model.nodes[n], where).run()) {
      instance.transform = transform;
      scene.nodes[n].children.push_back(static_cast<int>(scene.nodes.size()));
      scene.nodes.push_back(instance);
    }
  }
}

}  // namespace etendue::scene::gltf
