// A GLB file of any size: one mesh of a bumpy sphere with normals, and a light.
#pragma once
#include <cstddef>
#include <filesystem>

namespace etendue::test {

// Writes a file with about this many triangles and returns their number. Holds one ring of vertices at a time, so that
// writing does not affect later measurements of memory.
size_t write_large_glb(const std::filesystem::path& path, size_t triangles);

}  // namespace etendue::test
