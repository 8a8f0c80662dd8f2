#include "scene/gltf/import/primitive_triangles.h"

#include <numeric>

#include "scene/gltf/import/accessor.h"

namespace etendue::scene::gltf {
namespace {

constexpr uint32_t kUnused = 0xffffffffU;

std::string mode_name(int mode) {
  static constexpr const char* kNames[] = {"points", "lines", "line loops", "line strips"};
  return kNames[mode];
}

// Whether the index is the largest value of its type, which restarts a strip in graphics APIs; glTF forbids it.
bool is_restart(uint32_t index, int component_type) {
  return index == 0xffffffffU || (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && index == 0xff) ||
         (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT && index == 0xffff);
}

void check_range(const InputFile& input, int accessor, std::span<const uint32_t> indices, size_t vertices,
                 const std::string& where, std::vector<std::string>& warnings) {
  uint32_t largest = 0;
  for (const uint32_t i : indices) largest = std::max(largest, i);
  const int type = input.model.accessors[static_cast<size_t>(accessor)].componentType;
  if (largest < vertices) {
    if (is_restart(largest, type))
      warnings.push_back(
          where + ".indices: contains the primitive restart value, which glTF forbids; it is read as a vertex index");
    return;
  }
  const auto wrong = std::find_if(indices.begin(), indices.end(), [&](uint32_t i) { return i >= vertices; });
  fail(where + ".indices", "element " + std::to_string(wrong - indices.begin()) + " of accessor " +
                               std::to_string(accessor) + " is " + std::to_string(*wrong) +
                               (is_restart(*wrong, type) ? ", the primitive restart value, which glTF forbids" : "") +
                               ", but the primitive has " + std::to_string(vertices) + " vertices");
}

// Reads the first out.size() vertex indices of the list, strip or fan.
void read_corners(const InputFile& input, const tinygltf::Primitive& primitive, size_t vertices,
                  std::span<uint32_t> out, const std::string& where, std::vector<std::string>& warnings) {
  if (primitive.indices < 0) {
    std::iota(out.begin(), out.end(), 0U);
    return;
  }
  read_indices(input, primitive.indices, out, where + ".indices");
  check_range(input, primitive.indices, out, vertices, where, warnings);
}

}  // namespace

std::vector<Triangle> read_triangles(const InputFile& input, const tinygltf::Primitive& primitive, size_t vertices,
                                     const std::string& where, std::vector<std::string>& warnings) {
  const int mode = primitive.mode;
  if (mode < TINYGLTF_MODE_TRIANGLES) {
    warnings.push_back(where + ": " + mode_name(mode) + " are not rendered");
    return {};
  }
  const size_t corners = primitive.indices < 0 ? vertices : count_of(input, primitive.indices);
  const char* const kind = primitive.indices < 0 ? " vertices" : " indices";
  const bool list = mode == TINYGLTF_MODE_TRIANGLES;
  const size_t count = list ? corners / 3 : std::max<size_t>(corners, 2) - 2;
  if (count == 0) {
    warnings.push_back(where + ": has " + std::to_string(corners) + kind + "; a triangle needs 3");
    return {};
  }
  if (list && corners % 3 != 0)
    warnings.push_back(where + ": has " + std::to_string(corners) + kind + "; the last " + std::to_string(corners % 3) +
                       " cannot form a triangle");
  check_memory(input, count * sizeof(Triangle), where);
  std::vector<Triangle> triangles(count);
  if (list) {
    static_assert(sizeof(Triangle) == 3 * sizeof(uint32_t));
    read_corners(input, primitive, vertices, {triangles.front().data(), count * 3}, where, warnings);
    return triangles;
  }
  std::vector<uint32_t> strip(corners);
  read_corners(input, primitive, vertices, strip, where, warnings);
  // glTF 2.0, section 3.7.2.1: every second triangle of a strip has the opposite winding.
  for (size_t i = 0; i < count; ++i)
    triangles[i] = mode == TINYGLTF_MODE_TRIANGLE_STRIP ? Triangle{strip[i], strip[i + 1 + i % 2], strip[i + 2 - i % 2]}
                                                        : Triangle{strip[i + 1], strip[i + 2], strip[0]};
  return triangles;
}

std::vector<uint32_t> compact_vertices(std::vector<Triangle>& triangles, size_t vertices) {
  std::vector<uint32_t> number(vertices, kUnused);
  for (const Triangle& t : triangles)
    for (const uint32_t v : t) number[v] = 0;
  std::vector<uint32_t> chosen;
  for (uint32_t v = 0; v < vertices; ++v)
    if (number[v] != kUnused) {
      number[v] = static_cast<uint32_t>(chosen.size());
      chosen.push_back(v);
    }
  if (chosen.size() == vertices) return {};
  for (Triangle& t : triangles)
    for (uint32_t& v : t) v = number[v];
  return chosen;
}

}  // namespace etendue::scene::gltf
