// Builds small glTF files for tests. Arrays become accessors of one buffer; the rest is JSON that tests edit.
#pragma once
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/vec.h"

namespace etendue::test {

using nlohmann::json;

inline constexpr int kByte = 5120, kUByte = 5121, kShort = 5122, kUShort = 5123, kUInt = 5125, kFloat = 5126;

class Gltf {
 public:
  json root = {
      {"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", {{{"mesh", 0}}}}};

  // Adds a buffer view; returns its index.
  int view(const void* data, size_t size, int stride = 0) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    json v = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
    if (stride > 0) v["byteStride"] = stride;
    const auto* first = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
    root["bufferViews"].push_back(v);
    return static_cast<int>(root["bufferViews"].size()) - 1;
  }
  template <class T>
  int view(const std::vector<T>& values) {
    return view(values.data(), values.size() * sizeof(T));
  }

  int accessor(int view, int component, const char* type, size_t count, bool normalized = false) {
    json a = {{"componentType", component}, {"type", type}, {"count", count}};
    if (view >= 0) a["bufferView"] = view;
    if (normalized) a["normalized"] = true;
    root["accessors"].push_back(a);
    return static_cast<int>(root["accessors"].size()) - 1;
  }

  int floats(const std::vector<float>& v) { return accessor(view(v), kFloat, "SCALAR", v.size()); }
  int vec2(const std::vector<Vec2>& v) { return accessor(view(v), kFloat, "VEC2", v.size()); }
  int vec3(const std::vector<Vec3>& v) { return accessor(view(v), kFloat, "VEC3", v.size()); }
  int vec4(const std::vector<Vec4>& v) { return accessor(view(v), kFloat, "VEC4", v.size()); }
  int mat4(const std::vector<Mat4>& v) { return accessor(view(v), kFloat, "MAT4", v.size()); }
  int indices(const std::vector<uint16_t>& v) { return accessor(view(v), kUShort, "SCALAR", v.size()); }

  // Adds a primitive to mesh 0, the mesh of node 0.
  json& primitive(const json& attributes, int indices = -1) {
    json p = {{"attributes", attributes}};
    if (indices >= 0) p["indices"] = indices;
    if (!root.contains("meshes")) root["meshes"] = {{{"primitives", json::array()}}};
    json& primitives = root["meshes"][0]["primitives"];
    primitives.push_back(p);
    return primitives.back();
  }

  // The triangle (0,0,0), (1,0,0), (0,1,0).
  json& triangle() { return primitive({{"POSITION", vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}}); }
  // A closed surface whose triangles do not share vertices.
  json& tetrahedron() {
    const Vec3 p[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::vector<Vec3> corners;
    for (const int i : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) corners.push_back(p[i]);
    return primitive({{"POSITION", vec3(corners)}});
  }
  // The unit square in two triangles, with normals along z and one set of texture coordinates.
  json& square() {
    const json attributes = {{"POSITION", vec3({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})},
                             {"NORMAL", vec3(std::vector<Vec3>(4, Vec3(0, 0, 1)))},
                             {"TEXCOORD_0", vec2({{0, 1}, {1, 1}, {1, 0}, {0, 0}})}};
    return primitive(attributes, indices({0, 1, 2, 0, 2, 3}));
  }

  std::string glb() {
    if (!bytes_.empty()) root["buffers"] = {{{"byteLength", bytes_.size()}}};
    return glb_of(root.dump(), std::string(bytes_.begin(), bytes_.end()));
  }

  static std::string glb_of(std::string text, std::string binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    std::string file = "glTF" + word(2) + word(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
    file += word(text.size()) + "JSON" + text;
    if (!binary.empty()) file += word(binary.size()) + std::string("BIN\0", 4) + binary;
    return file;
  }

  static std::string word(size_t value) {
    const auto v = static_cast<uint32_t>(value);
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &v, 4);
    return bytes;
  }

  const std::vector<char>& bytes() const { return bytes_; }

 private:
  std::vector<char> bytes_;
};

}  // namespace etendue::test
