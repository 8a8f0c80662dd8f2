// Decodes a mesh that is compressed with KHR_draco_mesh_compression.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "scene/gltf/import/input_file.h"

namespace etendue::scene::gltf {

// One vertex attribute: which one to decode, and the type of the result.
struct DracoAttribute {
  std::string name;
  uint32_t id = 0;         // unique id within the compressed mesh
  int component_type = 0;  // TINYGLTF_COMPONENT_TYPE_*
  int components = 0;
  std::vector<std::byte> values;  // result: one element per vertex, `stride` bytes apart
  size_t stride = 0;              // bytes, a multiple of four
};

struct DracoMesh {
  size_t vertices = 0;
  std::vector<uint32_t> indices;  // three per triangle; each below `vertices`
};

// Decodes the mesh and fills the attributes. Throws FileError if the data are damaged, lack an attribute, or would need
// more memory than their size can justify.
DracoMesh decode_draco(const InputFile& input, Bytes compressed, std::vector<DracoAttribute>& attributes,
                       const std::string& where);

}  // namespace etendue::scene::gltf
