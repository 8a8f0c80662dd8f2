// EXT_meshopt_compression: the bytes of a buffer view.
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/gltf/document.h"

namespace etendue::scene::gltf {

// How a view is compressed; every combination that the extension forbids is found when it is read.
struct Meshopt {
  enum class Mode : uint8_t { attributes, triangles, indices };
  enum class Filter : uint8_t { none, octahedral, quaternion, exponential };

  uint64_t buffer = 0, offset = 0, length = 0;  // where the compressed bytes are
  uint64_t stride = 0, count = 0;               // what they become
  Mode mode = Mode::attributes;
  Filter filter = Filter::none;
};
Meshopt read_meshopt(const nlohmann::json& extension, const std::string& where);

// The stride * count bytes that `compressed` holds. Throws Unusable where it does not.
std::vector<std::byte> decode_meshopt(const Document& document, const Meshopt& description, Bytes compressed,
                                      const std::string& where);

}  // namespace etendue::scene::gltf
