// glTF files as JSON and the bytes that follow it in a GLB.
#pragma once
#include <filesystem>
#include <optional>

#include "integration/fuzz/mutation.h"

namespace etendue::fuzz {

struct Container {
  nlohmann::json root;
  Bytes rest;           // the chunks after the JSON
  bool binary = false;  // whether it is a GLB
};

// Nothing if the bytes are not glTF with valid JSON.
std::optional<Container> split_gltf(const Bytes& file);

// The file, with lengths in the headers that match it.
Bytes join_gltf(const Container& container);

// The content of a .gltf or .glb file, with the buffers and images next to it as data URIs. Empty if the file or one of
// these cannot be read, or if one of these has more than 256 KiB.
Bytes self_contained(const std::filesystem::path& file);

}  // namespace etendue::fuzz
