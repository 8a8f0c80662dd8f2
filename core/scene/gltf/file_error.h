// Errors inside the glTF importer and exporter.
#pragma once
#include <string>

namespace etendue::scene::gltf {

// Thrown where a file cannot be read or written. load_gltf and save_gltf catch it and put the file's name in front.
struct FileError {
  std::string message;
};

// `where` is the JSON path of an object, as "meshes[3].primitives[0]".
[[noreturn]] inline void fail(const std::string& where, const std::string& what) {
  throw FileError{where + ": " + what};
}

// One step of such a path: "meshes[3]".
inline std::string at(const char* array, size_t i) { return std::string(array) + "[" + std::to_string(i) + "]"; }

}  // namespace etendue::scene::gltf
