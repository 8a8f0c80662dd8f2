#include "scene/gltf/import/accessor.h"

#include <cassert>
#include <cstring>

namespace etendue::scene::gltf {
namespace {

const tinygltf::Accessor& accessor_of(const InputFile& input, int index) {
  assert(index >= 0 && static_cast<size_t>(index) < input.model.accessors.size());
  return input.model.accessors[static_cast<size_t>(index)];
}

size_t components_of(const tinygltf::Accessor& a) {
  return static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type)));
}
size_t element_size(const tinygltf::Accessor& a) { return component_size(a.componentType) * components_of(a); }

size_t stride_of(const InputFile& input, const tinygltf::Accessor& a) {
  const size_t stride = input.model.bufferViews[static_cast<size_t>(a.bufferView)].byteStride;
  return stride > 0 ? stride : element_size(a);
}

const std::byte* bytes_at(const InputFile& input, int view, size_t offset) {
  return view_bytes(input, view).bytes.data() + offset;
}

template <class T>
T load(const std::byte* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

// Whether integers are read as fractions: if the file says so, or if the use allows nothing else.
bool is_fraction(const tinygltf::Accessor& a, AccessorUse use) {
  const bool integer = a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT;
  const bool fraction = use == AccessorUse::color || use == AccessorUse::weights || use == AccessorUse::normal ||
                        use == AccessorUse::tangent || use == AccessorUse::morph_direction ||
                        use == AccessorUse::rotations || use == AccessorUse::morph_weights;
  return integer && (a.normalized || fraction);
}

// glTF 2.0, section 3.6.2.2: signed fractions are max(c / 127, -1).
template <class T, bool kFraction>
float number_at(const std::byte* p) {
  const auto v = static_cast<float>(load<T>(p));
  if constexpr (kFraction)
    return std::max(v / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
  else
    return v;
}

// `source(i)` returns the address of element i.
template <class T, bool kFraction, class Source>
void convert(Source&& source, size_t count, size_t components, size_t out_stride, float* out) {
  for (size_t i = 0; i < count; ++i, out += out_stride) {
    const std::byte* p = source(i);
    for (size_t c = 0; c < components; ++c) out[c] = number_at<T, kFraction>(p + c * sizeof(T));
  }
}

template <class Source>
void convert(Source&& source, size_t count, const tinygltf::Accessor& a, AccessorUse use, size_t out_stride,
             float* out) {
  const size_t n = components_of(a);
  const bool fraction = is_fraction(a, use);
  const auto as = [&]<class T>(T) {
    if (fraction)
      convert<T, true>(source, count, n, out_stride, out);
    else
      convert<T, false>(source, count, n, out_stride, out);
  };
  switch (a.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return as(int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return as(uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return as(int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return as(uint16_t{});
    default:
      return convert<float, false>(source, count, n, out_stride, out);
  }
}

uint32_t integer_at(const std::byte* p, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<uint8_t>(p);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<uint16_t>(p);
    default:
      return load<uint32_t>(p);
  }
}

// Calls replace(index, address) for each sparse value.
template <class Replace>
void for_each_sparse(const InputFile& input, const tinygltf::Accessor& a, const std::string& where, Replace&& replace) {
  if (!a.sparse.isSparse) return;
  const auto& indices = a.sparse.indices;
  const std::byte* index = bytes_at(input, indices.bufferView, static_cast<size_t>(indices.byteOffset));
  const std::byte* value = bytes_at(input, a.sparse.values.bufferView, static_cast<size_t>(a.sparse.values.byteOffset));
  for (int k = 0; k < a.sparse.count; ++k) {
    const uint32_t i = integer_at(index, indices.componentType);
    if (i >= a.count)
      fail(where, "has the sparse index " + std::to_string(i) + ", but the accessor has " + std::to_string(a.count) +
                      " elements");
    replace(i, value);
    index += component_size(indices.componentType);
    value += element_size(a);
  }
}

// Reads all elements. Each starts `out_stride` floats after the previous one; `out` is zero before.
void read_all(const InputFile& input, const tinygltf::Accessor& a, AccessorUse use, size_t out_stride, float* out,
              const std::string& where) {
  if (a.bufferView >= 0) {
    const std::byte* first = bytes_at(input, a.bufferView, a.byteOffset);
    const size_t stride = stride_of(input, a), size = element_size(a);
    const bool packed =
        a.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT && stride == size && out_stride * sizeof(float) == size;
    if (packed && a.count > 0)
      std::memcpy(out, first, a.count * size);
    else
      convert([&](size_t i) { return first + i * stride; }, a.count, a, use, out_stride, out);
  }
  for_each_sparse(input, a, where, [&](uint32_t i, const std::byte* value) {
    convert([&](size_t) { return value; }, 1, a, use, out_stride, out + i * out_stride);
  });
}

template <class V>
std::vector<V> read_vectors(const InputFile& input, int index, AccessorUse use, VertexSelection selection,
                            const V& initial, const std::string& where) {
  const auto& a = accessor_of(input, index);
  constexpr auto kComponents = static_cast<size_t>(sizeof(V) / sizeof(float));
  const size_t count = selection && !a.sparse.isSparse ? selection->size() : a.count;
  check_memory(input, count * sizeof(V), where);
  std::vector<V> values;
  values.reserve(count + 1);
  values.resize(count, initial);
  if (count == 0) return values;
  auto* out = reinterpret_cast<float*>(values.data());
  if (!selection || a.sparse.isSparse) {
    read_all(input, a, use, kComponents, out, where);
  } else if (a.bufferView >= 0) {
    const std::byte* first = bytes_at(input, a.bufferView, a.byteOffset);
    const size_t stride = stride_of(input, a);
    convert([&](size_t i) { return first + (*selection)[i] * stride; }, count, a, use, kComponents, out);
  }
  if (!selection || !a.sparse.isSparse) return values;
  std::vector<V> chosen;
  chosen.reserve(selection->size() + 1);
  for (const uint32_t i : *selection) chosen.push_back(values[i]);
  return chosen;
}

}  // namespace

size_t component_size(int type) {
  return static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(type)));
}

size_t count_of(const InputFile& input, int accessor) { return accessor_of(input, accessor).count; }

std::vector<Vec2> read_vec2(const InputFile& input, int accessor, AccessorUse use, VertexSelection selection,
                            const std::string& where) {
  return read_vectors(input, accessor, use, selection, Vec2(0), where);
}
std::vector<Vec3> read_vec3(const InputFile& input, int accessor, AccessorUse use, VertexSelection selection,
                            const std::string& where) {
  return read_vectors(input, accessor, use, selection, Vec3(0), where);
}
std::vector<Vec4> read_vec4(const InputFile& input, int accessor, AccessorUse use, VertexSelection selection,
                            const std::string& where) {
  const bool three = components_of(accessor_of(input, accessor)) == 3;
  return read_vectors(input, accessor, use, selection, Vec4(0, 0, 0, three ? 1 : 0), where);
}
std::vector<Mat4> read_matrices(const InputFile& input, int accessor, const std::string& where) {
  return read_vectors(input, accessor, AccessorUse::matrices, nullptr, Mat4(0), where);
}

std::vector<float> read_floats(const InputFile& input, int index, AccessorUse use, const std::string& where) {
  const auto& a = accessor_of(input, index);
  const size_t components = components_of(a);
  check_memory(input, a.count * components * sizeof(float), where);
  std::vector<float> values(a.count * components);
  read_all(input, a, use, components, values.data(), where);
  return values;
}

std::vector<std::array<uint16_t, 4>> read_joints(const InputFile& input, int index, VertexSelection selection,
                                                 const std::string& where) {
  using Joints = std::array<uint16_t, 4>;
  const auto& a = accessor_of(input, index);
  // Sparse indices count all elements of the accessor, so a sparse accessor is read completely.
  const bool select_early = selection && !a.sparse.isSparse;
  const size_t count = select_early ? selection->size() : a.count;
  check_memory(input, count * sizeof(Joints), where);
  std::vector<Joints> joints(count);
  const auto set = [&](size_t i, const std::byte* p) {
    for (size_t c = 0; c < 4; ++c)
      joints[i][c] = static_cast<uint16_t>(integer_at(p + c * component_size(a.componentType), a.componentType));
  };
  if (a.bufferView >= 0 && count > 0) {
    const std::byte* first = bytes_at(input, a.bufferView, a.byteOffset);
    const size_t stride = stride_of(input, a);
    for (size_t i = 0; i < count; ++i) set(i, first + (select_early ? (*selection)[i] : i) * stride);
  }
  for_each_sparse(input, a, where, set);
  if (!selection || select_early) return joints;
  std::vector<Joints> chosen;
  for (const uint32_t i : *selection) chosen.push_back(joints[i]);
  return chosen;
}

void read_indices(const InputFile& input, int index, std::span<uint32_t> out, const std::string& where) {
  const auto& a = accessor_of(input, index);
  assert(out.size() <= a.count);
  std::fill(out.begin(), out.end(), 0);
  if (a.bufferView >= 0 && !out.empty()) {
    const std::byte* first = bytes_at(input, a.bufferView, a.byteOffset);
    const size_t stride = stride_of(input, a);
    if (a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT && stride == sizeof(uint32_t))
      std::memcpy(out.data(), first, out.size_bytes());
    else
      for (size_t i = 0; i < out.size(); ++i) out[i] = integer_at(first + i * stride, a.componentType);
  }
  for_each_sparse(input, a, where, [&](uint32_t i, const std::byte* p) {
    if (i < out.size()) out[i] = integer_at(p, a.componentType);
  });
}

}  // namespace etendue::scene::gltf
