// A GLB as large as one likes: a bumpy sphere of one mesh, with normals, and a lamp.
#pragma once
#include <cstddef>
#include <filesystem>

namespace etendue::test {

// Writes it with about this many triangles, and returns how many they are. Holds one ring of vertices at a time, so
// that it does not count as memory of what is measured afterwards.
size_t write_large_glb(const std::filesystem::path& path, size_t triangles);

}  // namespace etendue::test
