// Accessors as arrays: every component type, stride, normalised integers, sparse values.            glTF 2.0, section 3.6.2
#include <cstring>

#include "scene/gltf_document.h"

namespace etendue::scene::gltf {
namespace {

const tinygltf::Accessor& accessor_at(const Document& d, int index, const std::string& where) {
  if (checked_index(index, d.model.accessors.size(), where, "accessors") < 0) fail(where, "names no accessor");
  return d.model.accessors[static_cast<size_t>(index)];
}

const unsigned char* data_at(const Document& d, int view, size_t offset) {
  const auto& v = d.model.bufferViews[static_cast<size_t>(view)];
  return d.model.buffers[static_cast<size_t>(v.buffer)].data.data() + v.byteOffset + offset;
}

template <class T>
T load(const unsigned char* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

// Section 3.6.2.2: c / 127 for signed integers stops at -1.
template <class T>
float as_float(const unsigned char* p, bool normalized) {
  const auto v = static_cast<float>(load<T>(p));
  if (!normalized) return v;
  return std::max(v / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

float component(const unsigned char* p, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return as_float<int8_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return as_float<uint8_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return as_float<int16_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return as_float<uint16_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return as_float<uint32_t>(p, normalized);
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return load<float>(p);
    case TINYGLTF_COMPONENT_TYPE_DOUBLE: return static_cast<float>(load<double>(p));
    default: return 0;
  }
}

uint32_t integer(const unsigned char* p, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return load<uint8_t>(p);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return load<uint16_t>(p);
    default: return load<uint32_t>(p);
  }
}

// Columns of small matrices start at multiples of four bytes.
size_t component_offset(const tinygltf::Accessor& a, int c) {
  const auto size = static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(a.componentType)));
  const auto i = static_cast<size_t>(c);
  if (a.type == TINYGLTF_TYPE_MAT2 && size == 1) return i / 2 * 4 + i % 2;
  if (a.type == TINYGLTF_TYPE_MAT3 && size < 4) return (i / 3 * (size == 1 ? 4 : 8)) + i % 3 * size;
  return i * size;
}

// Calls put(element, component, pointer) for everything the accessor holds; sparse values come last.
template <class Put>
void visit(const Document& d, const tinygltf::Accessor& a, int components, const std::string& where, Put&& put) {
  if (a.bufferView >= 0) {
    const auto stride = static_cast<size_t>(a.ByteStride(d.model.bufferViews[static_cast<size_t>(a.bufferView)]));
    const unsigned char* p = data_at(d, a.bufferView, a.byteOffset);
    for (size_t i = 0; i < a.count; ++i, p += stride)
      for (int c = 0; c < components; ++c) put(i, c, p + component_offset(a, c));
  }
  if (!a.sparse.isSparse) return;
  const auto n = static_cast<size_t>(a.sparse.count);
  const auto index_size = static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(a.sparse.indices.componentType)));
  const size_t element = static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(a.componentType))) *
                         static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type)));
  const unsigned char* indices = data_at(d, a.sparse.indices.bufferView, static_cast<size_t>(a.sparse.indices.byteOffset));
  const unsigned char* values = data_at(d, a.sparse.values.bufferView, static_cast<size_t>(a.sparse.values.byteOffset));
  for (size_t k = 0; k < n; ++k) {
    const uint32_t i = integer(indices + k * index_size, a.sparse.indices.componentType);
    if (i >= a.count) fail(where, "a sparse index is " + std::to_string(i) + ", but there are " + std::to_string(a.count) + " elements");
    for (int c = 0; c < components; ++c) put(i, c, values + k * element + component_offset(a, c));
  }
}

template <class V>
std::vector<V> read_vectors(const Document& d, int index, const std::string& where) {
  constexpr int kComponents = V::length();
  const auto& a = accessor_at(d, index, where);
  if (tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type)) != kComponents) fail(where, "accessors[" + std::to_string(index) + "] has to be a VEC" + std::to_string(kComponents));
  std::vector<V> out;
  out.reserve(a.count + 1);  // one more than is used: see Mesh::positions
  out.resize(a.count, V(0));
  const bool packed = a.bufferView >= 0 && !a.sparse.isSparse && a.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT &&
                      a.ByteStride(d.model.bufferViews[static_cast<size_t>(a.bufferView)]) == static_cast<int>(sizeof(V));
  if (packed)
    std::memcpy(out.data(), data_at(d, a.bufferView, a.byteOffset), a.count * sizeof(V));
  else
    visit(d, a, kComponents, where, [&](size_t i, int c, const unsigned char* p) { out[i][c] = component(p, a.componentType, a.normalized); });
  return out;
}

}  // namespace

std::vector<float> read_floats(const Document& d, int index, int components, const std::string& where) {
  const auto& a = accessor_at(d, index, where);
  if (tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type)) != components) fail(where, "accessors[" + std::to_string(index) + "] has to have " + std::to_string(components) + " components");
  std::vector<float> out(a.count * static_cast<size_t>(components), 0.0f);
  visit(d, a, components, where, [&](size_t i, int c, const unsigned char* p) {
    out[i * static_cast<size_t>(components) + static_cast<size_t>(c)] = component(p, a.componentType, a.normalized);
  });
  return out;
}

std::vector<Vec2> read_vec2(const Document& d, int index, const std::string& where) { return read_vectors<Vec2>(d, index, where); }
std::vector<Vec3> read_vec3(const Document& d, int index, const std::string& where) { return read_vectors<Vec3>(d, index, where); }
std::vector<Vec4> read_vec4(const Document& d, int index, const std::string& where) { return read_vectors<Vec4>(d, index, where); }

std::vector<uint32_t> read_integers(const Document& d, int index, int components, const std::string& where) {
  const auto& a = accessor_at(d, index, where);
  const bool unsigned_type = a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                             a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (!unsigned_type || tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type)) != components)
    fail(where, "accessors[" + std::to_string(index) + "] has to hold unsigned integers, " + std::to_string(components) + " each");
  std::vector<uint32_t> out(a.count * static_cast<size_t>(components), 0);
  visit(d, a, components, where, [&](size_t i, int c, const unsigned char* p) {
    out[i * static_cast<size_t>(components) + static_cast<size_t>(c)] = integer(p, a.componentType);
  });
  return out;
}

size_t count_of(const Document& d, int index) { return d.model.accessors[static_cast<size_t>(index)].count; }

}  // namespace etendue::scene::gltf
