// Accessors as arrays: every component type, stride, normalised integers, sparse values.        glTF 2.0, section 3.6.2
#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/vec.h"
#include "scene/gltf/document.h"

namespace etendue::scene::gltf {

// What an accessor is read as; each use allows certain types (sections 3.7.2, 3.11, KHR_mesh_quantization).
enum class Use : uint8_t {
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

// Throws Unusable unless the accessor is of a kind that this use allows and all its elements lie in their views.
// Readers rely on it. What is repaired goes to the document's warnings.
void check_accessor(Document& document, int accessor, Use use, const std::string& where);

// What is wrong with an accessor wherever it would be used; empty if nothing is.
std::string problem_of(const Document& document, int accessor);

size_t count_of(const Document& document, int accessor);

// The elements of which an array is made: all of an accessor, or chosen ones in this order.
using Selection = const std::vector<uint32_t>*;

// The accessor has passed check_accessor with this use; the selection's indices are below its count. Vectors keep
// capacity for one element more (see Mesh::positions).
std::vector<Vec2> read_vec2(const Document& document, int accessor, Use use, Selection selection,
                            const std::string& where);
std::vector<Vec3> read_vec3(const Document& document, int accessor, Use use, Selection selection,
                            const std::string& where);
// Three components are completed by a one.
std::vector<Vec4> read_vec4(const Document& document, int accessor, Use use, Selection selection,
                            const std::string& where);
std::vector<Mat4> read_matrices(const Document& document, int accessor, const std::string& where);
// Components one after another.
std::vector<float> read_floats(const Document& document, int accessor, Use use, const std::string& where);
std::vector<std::array<uint16_t, 4>> read_joints(const Document& document, int accessor, Selection selection,
                                                 const std::string& where);
// The first out.size() elements, which must not be more than there are.
void read_indices(const Document& document, int accessor, std::span<uint32_t> out, const std::string& where);

}  // namespace etendue::scene::gltf
