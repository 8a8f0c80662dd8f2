#include "support/textured_gltf.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "base/file.h"
#include "image/image.h"

namespace etendue::test {
namespace {

using nlohmann::json;

void write_noise(const std::filesystem::path& path, int size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<uint8_t> pixels(static_cast<size_t>(size) * static_cast<size_t>(size) * 3);
  for (uint8_t& value : pixels) value = static_cast<uint8_t>(128 + random() % 64);
  const auto png = image::encode_png(size, size, pixels);
  (void)write_file(path, png->data(), png->size());
}

}  // namespace

void write_textured_gltf(const std::filesystem::path& path, int squares, int size) {
  // Positions, texture coordinates and triangles of a square with corners at (0, 0) and (1, 1).
  const std::vector<float> vertices{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 1, 1, 1, 0, 0, 0};
  const std::vector<uint16_t> triangles{0, 1, 2, 0, 2, 3};
  const std::string buffer = path.stem().string() + ".bin";
  {
    std::ofstream file(path.parent_path() / buffer, std::ios::binary);
    file.write(reinterpret_cast<const char*>(vertices.data()), 80);
    file.write(reinterpret_cast<const char*>(triangles.data()), 12);
  }
  json root = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"buffers", json::array({{{"byteLength", 92}, {"uri", buffer}}})},
      {"bufferViews", json::array({{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}},
                                   {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 32}},
                                   {{"buffer", 0}, {"byteOffset", 80}, {"byteLength", 12}}})},
      {"accessors", json::array({{{"bufferView", 0},
                                  {"componentType", 5126},
                                  {"count", 4},
                                  {"type", "VEC3"},
                                  {"min", {0, 0, 0}},
                                  {"max", {1, 1, 0}}},
                                 {{"bufferView", 1}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
                                 {{"bufferView", 2}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}})}};
  for (int i = 0; i < squares; ++i) {
    const std::string image = path.stem().string() + "-" + std::to_string(i) + ".png";
    write_noise(path.parent_path() / image, size, static_cast<unsigned>(i));
    root["images"].push_back({{"uri", image}});
    root["textures"].push_back({{"source", i}});
    root["materials"].push_back(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}, {"metallicFactor", 0}}}});
    root["meshes"].push_back(
        {{"primitives",
          json::array({{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", 2}, {"material", i}}})}});
    root["nodes"].push_back({{"mesh", i}, {"translation", {1.1 * i, 0, 0}}});
    root["scenes"][0]["nodes"].push_back(i);
  }
  std::ofstream(path) << root;
}

}  // namespace etendue::test
