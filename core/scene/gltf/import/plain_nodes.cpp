#include "scene/gltf/import/plain_nodes.h"

#include <string>

namespace etendue::scene::gltf {
namespace {

using nlohmann::json;

// The elements of an array; none if the member is missing or has another type.
template <class T>
std::vector<T> list_of(const json& object, const char* member) {
  const auto found = object.find(member);
  return found != object.end() && found->is_array() ? found->get<std::vector<T>>() : std::vector<T>();
}

int index_of(const json& object, const char* member) {
  const auto found = object.find(member);
  return found != object.end() ? found->get<int>() : -1;
}

tinygltf::Node node_of(const json& object) {
  tinygltf::Node node;
  if (const auto name = object.find("name"); name != object.end() && name->is_string()) node.name = *name;
  node.children = list_of<int>(object, "children");
  node.mesh = index_of(object, "mesh");
  node.camera = index_of(object, "camera");
  node.skin = index_of(object, "skin");
  node.weights = list_of<double>(object, "weights");
  // As in tinygltf, a matrix replaces the other transforms.
  node.matrix = list_of<double>(object, "matrix");
  if (!node.matrix.empty()) return node;
  node.translation = list_of<double>(object, "translation");
  node.rotation = list_of<double>(object, "rotation");
  node.scale = list_of<double>(object, "scale");
  return node;
}

}  // namespace

PlainNodes::PlainNodes(json& root) {
  const auto array = root.find("nodes");
  if (array == root.end()) return;
  json others = json::array();
  nodes_.reserve(array->size());
  for (json& object : *array) {
    if (object.contains("extensions")) {
      others_.push_back(nodes_.size());
      others.push_back(std::move(object));
      nodes_.emplace_back();
    } else {
      nodes_.push_back(node_of(object));
    }
  }
  *array = std::move(others);
}

void PlainNodes::add_to(std::vector<tinygltf::Node>& nodes) {
  for (size_t i = 0; i < others_.size(); ++i) nodes_[others_[i]] = std::move(nodes[i]);
  nodes = std::move(nodes_);
}

}  // namespace etendue::scene::gltf
