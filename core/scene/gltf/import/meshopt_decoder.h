// Decodes a buffer view that is compressed with EXT_meshopt_compression.
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/gltf/import/input_file.h"

namespace etendue::scene::gltf {

// The extension object of a buffer view.
struct MeshoptView {
  enum class Mode : uint8_t { attributes, triangles, indices };
  enum class Filter : uint8_t { none, octahedral, quaternion, exponential };

  uint64_t buffer = 0, offset = 0, length = 0;  // the compressed bytes
  uint64_t stride = 0, count = 0;               // the decoded elements: `count` of `stride` bytes
  Mode mode = Mode::attributes;
  Filter filter = Filter::none;
};
// Throws FileError for every combination that the extension forbids.
MeshoptView read_meshopt_view(const nlohmann::json& extension, const std::string& where);

// The stride * count bytes that `compressed` encodes. Throws FileError if it does not.
std::vector<std::byte> decode_meshopt(const InputFile& input, const MeshoptView& view, Bytes compressed,
                                      const std::string& where);

}  // namespace etendue::scene::gltf
