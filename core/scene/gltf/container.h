// The outer shell of a glTF file: JSON text alone, or GLB chunks.                                   glTF 2.0,
// section 4.4
#pragma once
#include <string_view>

#include "scene/gltf/document.h"

namespace etendue::scene::gltf {

struct Container {
  std::string_view json;
  Bytes binary;
  bool has_binary = false;
};

// Parts of `file`, which has to outlive them. Throws Unusable.
Container split_container(Bytes file, std::vector<std::string>& warnings);

}  // namespace etendue::scene::gltf
