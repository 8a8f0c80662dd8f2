// Nodes without extensions, which are read here and not by tinygltf: files with many instances consist of them, and
// tinygltf would parse their text a second time.
#pragma once
#include <tiny_gltf.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace etendue::scene::gltf {

class PlainNodes {
 public:
  // Removes the nodes without extensions from a root that check_structure has passed.
  explicit PlainNodes(nlohmann::json& root);

  // Inserts them into the nodes that tinygltf has parsed.
  void add_to(std::vector<tinygltf::Node>& nodes);

 private:
  std::vector<tinygltf::Node> nodes_;  // of the file; those with extensions are empty
  std::vector<size_t> others_;         // indices of nodes with extensions
};

}  // namespace etendue::scene::gltf
