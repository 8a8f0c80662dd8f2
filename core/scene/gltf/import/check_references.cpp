// Checks all references of a file before any object is read.                       glTF 2.0, sections 3.5 to 3.11
#include <optional>

#include "scene/gltf/import/accessor.h"
#include "scene/gltf/import/importers.h"

namespace etendue::scene::gltf {
namespace {

// Visits each object that refers to others, so that messages name the object with the wrong reference.
class ReferenceChecker {
 public:
  explicit ReferenceChecker(InputFile& input)
      : input_(input), model_(input.model), used_(model_.accessors.size(), false) {}

  void run() {
    for (size_t m = 0; m < model_.meshes.size(); ++m) mesh(model_.meshes[m], at("meshes", m));
    nodes();
    for (size_t s = 0; s < model_.skins.size(); ++s) skin(model_.skins[s], at("skins", s));
    for (size_t a = 0; a < model_.animations.size(); ++a) animation(model_.animations[a], at("animations", a));
    for (size_t s = 0; s < model_.scenes.size(); ++s)
      for (size_t i = 0; i < model_.scenes[s].nodes.size(); ++i)
        checked_index(model_.scenes[s].nodes[i], model_.nodes.size(), at("scenes", s) + "." + at("nodes", i), "nodes");
    if (model_.defaultScene >= 0) checked_index(model_.defaultScene, model_.scenes.size(), "scene", "scenes");
    unused();
  }

 private:
  void accessor(int index, AccessorUse use, const std::string& where) {
    check_accessor(input_, index, use, where);
    used_[static_cast<size_t>(index)] = true;
  }

  // An accessor with one element per vertex.
  void attribute(int index, AccessorUse use, size_t vertices, const std::string& where) {
    accessor(index, use, where);
    if (const size_t count = count_of(input_, index); count != vertices)
      fail(where, "accessor " + std::to_string(index) + " has " + std::to_string(count) +
                      " elements, but POSITION has " + std::to_string(vertices));
  }

  void mesh(const tinygltf::Mesh& mesh, const std::string& where) {
    for (size_t p = 0; p < mesh.primitives.size(); ++p)
      primitive(mesh.primitives[p], where + "." + at("primitives", p));
  }

  void primitive(const tinygltf::Primitive& primitive, const std::string& where) {
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
      fail(where + ".mode", std::to_string(primitive.mode) + " is not a mode; it has to be between 0 and 6");
    if (primitive.material >= 0)
      checked_index(primitive.material, model_.materials.size(), where + ".material", "materials");
    if (primitive.indices >= 0) accessor(primitive.indices, AccessorUse::indices, where + ".indices");
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return;  // nothing to render; the mesh importer adds a warning
    accessor(position->second, AccessorUse::position, where + ".attributes.POSITION");
    const size_t vertices = count_of(input_, position->second);
    for (const auto& [name, index] : primitive.attributes)
      if (const auto use = use_of(name)) attribute(index, *use, vertices, where + ".attributes." + name);
    for (const auto& [name, index] : primitive.attributes) check_joint_pair(primitive, name, where);
    for (size_t t = 0; t < primitive.targets.size(); ++t)
      for (const auto& [name, index] : primitive.targets[t]) {
        const bool read = name == "POSITION" || name == "NORMAL" || name == "TANGENT";
        const AccessorUse use = name == "POSITION" ? AccessorUse::morph_position : AccessorUse::morph_direction;
        if (read) attribute(index, use, vertices, where + "." + at("targets", t) + "." + name);
      }
  }

  // The attributes that the importer reads.
  static std::optional<AccessorUse> use_of(const std::string& name) {
    if (name == "NORMAL") return AccessorUse::normal;
    if (name == "TANGENT") return AccessorUse::tangent;
    if (name == "TEXCOORD_0" || name == "TEXCOORD_1") return AccessorUse::uv;
    if (name == "COLOR_0") return AccessorUse::color;
    if (name.starts_with("JOINTS_")) return AccessorUse::joints;
    if (name.starts_with("WEIGHTS_")) return AccessorUse::weights;
    return std::nullopt;
  }

  void check_joint_pair(const tinygltf::Primitive& primitive, const std::string& name, const std::string& where) {
    for (const auto& [one, other] : {std::pair("JOINTS_", "WEIGHTS_"), std::pair("WEIGHTS_", "JOINTS_")})
      if (name.starts_with(one) && !primitive.attributes.contains(other + name.substr(std::string(one).size())))
        input_.warnings.push_back(where + ".attributes: has " + name + " without " + other +
                                  name.substr(std::string(one).size()) + "; it is ignored");
  }

  void nodes() {
    std::vector<int> parents(model_.nodes.size(), -1);
    for (size_t i = 0; i < model_.nodes.size(); ++i) {
      const auto& node = model_.nodes[i];
      const std::string where = at("nodes", i);
      if (node.mesh >= 0) checked_index(node.mesh, model_.meshes.size(), where + ".mesh", "meshes");
      if (node.camera >= 0) checked_index(node.camera, model_.cameras.size(), where + ".camera", "cameras");
      if (node.skin >= 0) checked_index(node.skin, model_.skins.size(), where + ".skin", "skins");
      for (const int child : node.children) {
        int& parent = parents[checked_index(child, model_.nodes.size(), where + ".children", "nodes")];
        if (parent >= 0)
          fail(where + ".children", "nodes[" + std::to_string(child) + "] is already a child of nodes[" +
                                        std::to_string(parent) + "]; a node has at most one parent");
        parent = static_cast<int>(i);
      }
      instances(node, where + ".extensions.EXT_mesh_gpu_instancing.attributes");
    }
    trees(parents);
  }

  // All attributes have one element per instance.
  void instances(const tinygltf::Node& node, const std::string& where) {
    const auto* extension = find_extension(node.extensions, "EXT_mesh_gpu_instancing");
    if (!extension) return;
    std::optional<size_t> count;
    for (const auto& [name, use] :
         {std::pair("TRANSLATION", AccessorUse::vectors), std::pair("ROTATION", AccessorUse::rotations),
          std::pair("SCALE", AccessorUse::vectors)}) {
      const int index = index_or(extension->Get("attributes"), name, -1);
      if (index < 0) continue;
      accessor(index, use, where + "." + name);
      if (count && *count != count_of(input_, index))
        fail(where + "." + name, "has " + std::to_string(count_of(input_, index)) +
                                     " elements, but other attributes have " + std::to_string(*count));
      count = count_of(input_, index);
    }
  }

  // Each node has at most one parent here, so following parents ends at a root or returns to the same node.
  void trees(const std::vector<int>& parents) {
    std::vector<size_t> visited_from(parents.size(), SIZE_MAX);
    for (size_t i = 0; i < parents.size(); ++i)
      for (int node = static_cast<int>(i); node >= 0; node = parents[static_cast<size_t>(node)]) {
        size_t& visited = visited_from[static_cast<size_t>(node)];
        if (visited == i) fail(at("nodes", static_cast<size_t>(node)), "is its own ancestor; nodes have to form trees");
        if (visited != SIZE_MAX) break;
        visited = i;
      }
  }

  void skin(const tinygltf::Skin& skin, const std::string& where) {
    for (size_t j = 0; j < skin.joints.size(); ++j)
      checked_index(skin.joints[j], model_.nodes.size(), where + "." + at("joints", j), "nodes");
    if (skin.inverseBindMatrices < 0) return;
    accessor(skin.inverseBindMatrices, AccessorUse::matrices, where + ".inverseBindMatrices");
    if (const size_t count = count_of(input_, skin.inverseBindMatrices); count < skin.joints.size())
      fail(where + ".inverseBindMatrices", "accessor " + std::to_string(skin.inverseBindMatrices) + " has " +
                                               std::to_string(count) + " matrices for " +
                                               std::to_string(skin.joints.size()) + " joints");
  }

  void animation(const tinygltf::Animation& animation, const std::string& where) {
    for (size_t c = 0; c < animation.channels.size(); ++c) {
      const auto& channel = animation.channels[c];
      const std::string at_channel = where + "." + at("channels", c);
      if (channel.target_node >= 0)
        checked_index(channel.target_node, model_.nodes.size(), at_channel + ".target.node", "nodes");
      const size_t s = checked_index(channel.sampler, animation.samplers.size(), at_channel + ".sampler", "samplers");
      const std::string at_sampler = where + "." + at("samplers", s);
      const auto use = output_use(channel.target_path);
      if (!use) continue;
      accessor(animation.samplers[s].input, AccessorUse::times, at_sampler + ".input");
      accessor(animation.samplers[s].output, *use, at_sampler + ".output");
    }
  }

  static std::optional<AccessorUse> output_use(const std::string& path) {
    if (path == "translation" || path == "scale") return AccessorUse::vectors;
    if (path == "rotation") return AccessorUse::rotations;
    if (path == "weights") return AccessorUse::morph_weights;
    return std::nullopt;
  }

  void unused() {
    for (size_t a = 0; a < used_.size(); ++a) {
      if (used_[a]) continue;
      if (const std::string problem = accessor_problem(input_, static_cast<int>(a)); !problem.empty())
        input_.warnings.push_back(at("accessors", a) + ": " + problem + "; nothing uses it");
    }
    for (size_t v = 0; v < model_.bufferViews.size(); ++v)
      if (const ViewBytes view = view_bytes(input_, static_cast<int>(v)); !view.problem.empty())
        input_.warnings.push_back(at("bufferViews", v) + ": " + view.problem);
    for (size_t b = 0; b < input_.buffers.size(); ++b)
      if (const std::string& problem = input_.buffers[b].problem; !problem.empty() && !input_.buffers[b].placeholder)
        input_.warnings.push_back(at("buffers", b) + ": " + problem);
  }

  InputFile& input_;
  const tinygltf::Model& model_;
  std::vector<bool> used_;
};

}  // namespace

size_t checked_index(int i, size_t size, const std::string& where, const char* array) {
  if (i < 0 || static_cast<size_t>(i) >= size)
    fail(where, "refers to " + std::string(array) + "[" + std::to_string(i) + "], which does not exist; the file has " +
                    std::to_string(size));
  return static_cast<size_t>(i);
}

void check_references(InputFile& input) { ReferenceChecker(input).run(); }

}  // namespace etendue::scene::gltf
