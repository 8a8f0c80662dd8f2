// KHR_draco_mesh_compression: the mesh that a buffer view holds.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "scene/gltf/document.h"

namespace etendue::scene::gltf {

// One attribute: which one of the compressed mesh is wanted, and as what.
struct DracoAttribute {
  std::string name;
  uint32_t id = 0;         // of the compressed mesh
  int component_type = 0;  // TINYGLTF_COMPONENT_TYPE_*
  int components = 0;
  std::vector<std::byte> values;  // packed, one element a vertex; rows begin at multiples of four bytes
  size_t stride = 0;
};

struct DracoMesh {
  size_t vertices = 0;
  std::vector<uint32_t> indices;  // three a triangle; each below `vertices`
};

// Decodes the bytes and fills the attributes. Throws Unusable where they are damaged, lack an attribute, or would need
// more memory than their size can justify.
DracoMesh decode_draco(const Document& document, Bytes compressed, std::vector<DracoAttribute>& attributes,
                       const std::string& where);

}  // namespace etendue::scene::gltf
