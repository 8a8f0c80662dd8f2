#include "support/large_glb.h"

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace etendue::test {
namespace {

// Rings of vertices around the axis. The poles are rings as well; their degenerate triangles are left out.
struct Grid {
  uint32_t rings, segments;

  size_t vertices() const { return size_t{rings + 1} * segments; }
  size_t triangles() const { return size_t{2} * (rings - 1) * segments; }

  Vec3 direction(uint32_t i, uint32_t j) const {
    const float theta = kPi * static_cast<float>(i) / static_cast<float>(rings);
    const float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(segments);
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
  }
};

Vec3 bumpy(const Vec3& d) { return d * (1 + 0.02f * std::sin(40 * d.x) * std::sin(37 * d.y) * std::sin(43 * d.z)); }

template <class T>
void put(std::ofstream& file, const std::vector<T>& values) {
  file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

void put_word(std::ofstream& file, size_t word) {
  const auto value = static_cast<uint32_t>(word);
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Point>
void put_vertices(std::ofstream& file, const Grid& grid, Point&& point) {
  std::vector<Vec3> ring(grid.segments);
  for (uint32_t i = 0; i <= grid.rings; ++i) {
    for (uint32_t j = 0; j < grid.segments; ++j) ring[j] = point(grid.direction(i, j));
    put(file, ring);
  }
}

void put_triangles(std::ofstream& file, const Grid& grid) {
  std::vector<Triangle> ring;
  for (uint32_t i = 0; i < grid.rings; ++i) {
    ring.clear();
    for (uint32_t j = 0; j < grid.segments; ++j) {
      const uint32_t a = i * grid.segments + j, b = i * grid.segments + (j + 1) % grid.segments;
      const uint32_t c = a + grid.segments, d = b + grid.segments;
      if (i > 0) ring.push_back({a, b, c});
      if (i + 1 < grid.rings) ring.push_back({b, d, c});
    }
    put(file, ring);
  }
}

std::string structure(const Grid& grid) {
  const std::string vertices = std::to_string(grid.vertices()), corners = std::to_string(3 * grid.triangles());
  const std::string third = std::to_string(grid.vertices() * sizeof(Vec3));
  const size_t indices = grid.triangles() * sizeof(Triangle), before = 2 * grid.vertices() * sizeof(Vec3);
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],)"
      R"("extensionsUsed":["KHR_lights_punctual"],)"
      R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional","intensity":3}]}},)"
      R"("nodes":[{"mesh":0},{"rotation":[-0.38,0,0,0.92],"extensions":{"KHR_lights_punctual":{"light":0}}}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"indices":2,"material":0}]}],)"
      R"("materials":[{"pbrMetallicRoughness":{"metallicFactor":0}}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","min":[-1.1,-1.1,-1.1],"max":[1.1,1.1,1.1],)"
      R"("count":)" +
      vertices + R"(},{"bufferView":1,"componentType":5126,"type":"VEC3","count":)" + vertices +
      R"(},{"bufferView":2,"componentType":5125,"type":"SCALAR","count":)" + corners +
      R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + third + R"(},{"buffer":0,"byteOffset":)" + third +
      R"(,"byteLength":)" + third + R"(},{"buffer":0,"byteOffset":)" + std::to_string(before) + R"(,"byteLength":)" +
      std::to_string(indices) + R"(}],"buffers":[{"byteLength":)" + std::to_string(before + indices) + "}]}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  return json;
}

}  // namespace

size_t write_large_glb(const std::filesystem::path& path, size_t triangles) {
  const auto rings = static_cast<uint32_t>(std::lround(0.5 * std::sqrt(static_cast<double>(triangles)) + 0.5));
  const Grid grid{rings, 2 * rings};
  const std::string json = structure(grid);
  const size_t binary = 2 * grid.vertices() * sizeof(Vec3) + grid.triangles() * sizeof(Triangle);
  std::ofstream file(path, std::ios::binary);
  file.write("glTF", 4);
  put_word(file, 2);
  put_word(file, 12 + 8 + json.size() + 8 + binary);
  put_word(file, json.size());
  file.write("JSON", 4);
  file << json;
  put_word(file, binary);
  file.write("BIN\0", 4);
  put_vertices(file, grid, bumpy);
  put_vertices(file, grid, [](const Vec3& d) { return d; });
  put_triangles(file, grid);
  return grid.triangles();
}

}  // namespace etendue::test
