// A glTF file whose textures take long to decode: a row of squares, each with a PNG of its own.
#pragma once
#include <filesystem>

namespace etendue::test {

// Writes `squares` images of `size` x `size` pixels beside the file. They are lossless and noisy.
void write_textured_gltf(const std::filesystem::path& path, int squares, int size);

}  // namespace etendue::test
