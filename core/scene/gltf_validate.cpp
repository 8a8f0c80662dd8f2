// What tinygltf leaves unchecked.                                                        glTF 2.0, sections 3.6, 5.1, 5.11
#include <set>

#include "scene/gltf_document.h"

namespace etendue::scene::gltf {
namespace {

constexpr uint64_t kMostWithoutData = uint64_t{1} << 24;  // elements of an accessor that is all zeros

std::string bytes_text(uint64_t n) { return std::to_string(n) + " bytes"; }

void validate_views(const tinygltf::Model& model) {
  for (size_t i = 0; i < model.bufferViews.size(); ++i) {
    const auto& view = model.bufferViews[i];
    const std::string where = at("bufferViews", i);
    if (checked_index(view.buffer, model.buffers.size(), where + ".buffer", "buffers") < 0) fail(where, "names no buffer");
    const uint64_t size = model.buffers[static_cast<size_t>(view.buffer)].data.size();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
      fail(where, "ends at byte " + std::to_string(view.byteOffset) + " + " + std::to_string(view.byteLength) + ", but buffers[" +
                      std::to_string(view.buffer) + "] has " + bytes_text(size));
  }
}

// A run of `count` elements of `size` bytes, `stride` apart, has to end inside the view.
void validate_run(const tinygltf::Model& model, int view_index, uint64_t offset, uint64_t count, uint64_t size, uint64_t stride,
                  const std::string& where) {
  const auto& view = model.bufferViews[static_cast<size_t>(checked_index(view_index, model.bufferViews.size(), where, "bufferViews"))];
  if (count == 0) return;
  const uint64_t length = view.byteLength;
  const bool fits = offset <= length && size <= length - offset && (count - 1) <= (length - offset - size) / std::max<uint64_t>(stride, 1);
  if (!fits)
    fail(where, std::to_string(count) + " elements of " + bytes_text(size) + " from byte " + std::to_string(offset) +
                    " do not fit into bufferViews[" + std::to_string(view_index) + "], which has " + bytes_text(length));
}

void validate_accessors(const tinygltf::Model& model) {
  for (size_t i = 0; i < model.accessors.size(); ++i) {
    const auto& a = model.accessors[i];
    const std::string where = at("accessors", i);
    const int component = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(a.componentType));
    const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type));
    if (component <= 0 || components <= 0) fail(where, "has a component type or type that glTF does not know");
    const auto size = static_cast<uint64_t>(component) * static_cast<uint64_t>(components);
    if (a.bufferView >= 0) {
      checked_index(a.bufferView, model.bufferViews.size(), where + ".bufferView", "bufferViews");
      const int stride = a.ByteStride(model.bufferViews[static_cast<size_t>(a.bufferView)]);
      if (stride <= 0) fail(where, "has a byteStride that is no multiple of its component size");
      validate_run(model, a.bufferView, a.byteOffset, a.count, size, static_cast<uint64_t>(stride), where);
    } else if (a.bufferView < -1 || a.count > kMostWithoutData) {
      fail(where, "claims " + std::to_string(a.count) + " elements but has no bufferView");
    }
    if (!a.sparse.isSparse) continue;
    if (a.sparse.count < 0 || static_cast<uint64_t>(a.sparse.count) > a.count) fail(where + ".sparse", "replaces more elements than there are");
    const int index_size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(a.sparse.indices.componentType));
    if (index_size <= 0 || a.sparse.indices.byteOffset < 0 || a.sparse.values.byteOffset < 0) fail(where + ".sparse", "has no usable indices");
    const auto n = static_cast<uint64_t>(a.sparse.count);
    validate_run(model, a.sparse.indices.bufferView, static_cast<uint64_t>(a.sparse.indices.byteOffset), n, static_cast<uint64_t>(index_size), static_cast<uint64_t>(index_size), where + ".sparse.indices");
    validate_run(model, a.sparse.values.bufferView, static_cast<uint64_t>(a.sparse.values.byteOffset), n, size, size, where + ".sparse.values");
  }
}

void validate_nodes(const tinygltf::Model& model) {
  std::vector<int> parent(model.nodes.size(), -1);
  for (size_t i = 0; i < model.nodes.size(); ++i) {
    const auto& n = model.nodes[i];
    const std::string where = at("nodes", i);
    checked_index(n.mesh, model.meshes.size(), where + ".mesh", "meshes");
    checked_index(n.camera, model.cameras.size(), where + ".camera", "cameras");
    checked_index(n.skin, model.skins.size(), where + ".skin", "skins");
    for (const int child : n.children) {
      if (checked_index(child, model.nodes.size(), where + ".children", "nodes") < 0) fail(where, "has a child that is no node");
      if (parent[static_cast<size_t>(child)] >= 0) fail(where, "claims nodes[" + std::to_string(child) + "], which has a parent already; a node has one parent");
      parent[static_cast<size_t>(child)] = static_cast<int>(i);
    }
  }
  // With one parent each, a walk upwards that does not end within as many steps as there are nodes goes in a circle.
  std::vector<uint8_t> ends(model.nodes.size(), 0);
  for (size_t i = 0; i < model.nodes.size(); ++i) {
    std::vector<size_t> walk;
    int node = static_cast<int>(i);
    while (node >= 0 && !ends[static_cast<size_t>(node)]) {
      if (walk.size() > model.nodes.size()) fail(at("nodes", i), "is its own ancestor; nodes have to form trees");
      walk.push_back(static_cast<size_t>(node));
      node = parent[static_cast<size_t>(node)];
    }
    for (const size_t w : walk) ends[w] = 1;
  }
  for (size_t s = 0; s < model.scenes.size(); ++s)
    for (const int root : model.scenes[s].nodes)
      if (checked_index(root, model.nodes.size(), at("scenes", s) + ".nodes", "nodes") < 0) fail(at("scenes", s), "lists a node that is none");
}

}  // namespace

int checked_index(int i, size_t size, const std::string& where, const char* of) {
  if (i >= -1 && (i < 0 || static_cast<size_t>(i) < size)) return i;
  fail(where, "names " + std::string(of) + "[" + std::to_string(i) + "], but there are " + std::to_string(size));
}

bool is_supported(const std::string& extension) {
  static const std::set<std::string> kSupported{
      "KHR_materials_emissive_strength", "KHR_lights_punctual", "KHR_texture_transform", "KHR_materials_unlit", "KHR_materials_ior",
      "KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_specular", "KHR_materials_anisotropy", "KHR_mesh_quantization",
      "EXT_texture_webp"};
  return kSupported.contains(extension);
}

void validate(const Document& document) {
  for (const auto& extension : document.model.extensionsRequired)
    if (!is_supported(extension)) throw Unusable{"requires the extension " + extension + ", which is not supported"};
  validate_views(document.model);
  validate_accessors(document.model);
  validate_nodes(document.model);
}

}  // namespace etendue::scene::gltf
