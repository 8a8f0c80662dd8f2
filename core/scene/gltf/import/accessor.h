// Reads accessors into arrays: all component types, strides, normalised integers and sparse values.
//                                                                                            glTF 2.0, section 3.6.2
#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/vec.h"
#include "scene/gltf/import/input_file.h"

namespace etendue::scene::gltf {

// What an accessor is used as. Each use allows certain types (glTF 2.0, sections 3.7.2 and 3.11;
// KHR_mesh_quantization).
enum class AccessorUse : uint8_t {
  position,
  normal,
  tangent,
  uv,
  color,
  joints,
  weights,
  morph_position,
  morph_direction,
  indices,
  matrices,
  times,
  vectors,
  rotations,
  morph_weights,
};

// Throws FileError unless the use allows the accessor's type and all its elements lie inside their buffer views. The
// read functions below rely on it. Deviations that can be read anyway are added to the warnings of the file.
void check_accessor(InputFile& input, int accessor, AccessorUse use, const std::string& where);

// What is wrong with an accessor independent of its use; empty if nothing is.
std::string accessor_problem(const InputFile& input, int accessor);

// The bytes of a component of a glTF component type.
size_t component_size(int type);

size_t count_of(const InputFile& input, int accessor);

// Indices of the elements to read, in this order; null reads all.
using VertexSelection = const std::vector<uint32_t>*;

// Preconditions of all read functions: the accessor has passed check_accessor with this use, and the indices of the
// selection are below its count. Arrays of vectors have capacity for one more element (see Mesh::positions).
std::vector<Vec2> read_vec2(const InputFile& input, int accessor, AccessorUse use, VertexSelection selection,
                            const std::string& where);
std::vector<Vec3> read_vec3(const InputFile& input, int accessor, AccessorUse use, VertexSelection selection,
                            const std::string& where);
// The fourth component of a VEC3 accessor is 1.
std::vector<Vec4> read_vec4(const InputFile& input, int accessor, AccessorUse use, VertexSelection selection,
                            const std::string& where);
std::vector<Mat4> read_matrices(const InputFile& input, int accessor, const std::string& where);
// The components of all elements, one element after the other.
std::vector<float> read_floats(const InputFile& input, int accessor, AccessorUse use, const std::string& where);
std::vector<std::array<uint16_t, 4>> read_joints(const InputFile& input, int accessor, VertexSelection selection,
                                                 const std::string& where);
// The first out.size() elements; out.size() is at most count_of(accessor).
void read_indices(const InputFile& input, int accessor, std::span<uint32_t> out, const std::string& where);

}  // namespace etendue::scene::gltf
