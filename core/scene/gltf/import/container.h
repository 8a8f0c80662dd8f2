// The container of a glTF file: JSON text alone, or the chunks of a GLB.                       glTF 2.0, section 4.4
#pragma once
#include <string_view>

#include "scene/gltf/import/input_file.h"

namespace etendue::scene::gltf {

struct Container {
  std::string_view json;
  Bytes binary;
  bool has_binary = false;
};

// The parts point into `file`, which must outlive them. Throws FileError.
Container split_container(Bytes file, std::vector<std::string>& warnings);

}  // namespace etendue::scene::gltf
