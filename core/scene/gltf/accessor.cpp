#include "scene/gltf/accessor.h"

#include <cassert>
#include <cstring>

namespace etendue::scene::gltf {
namespace {

const tinygltf::Accessor& accessor_of(const Document& document, int index) {
  assert(index >= 0 && static_cast<size_t>(index) < document.model.accessors.size());
  return document.model.accessors[static_cast<size_t>(index)];
}

size_t component_size(int type) {
  return static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(type)));
}
size_t components_of(const tinygltf::Accessor& a) {
  return static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type)));
}
size_t element_size(const tinygltf::Accessor& a) { return component_size(a.componentType) * components_of(a); }

size_t stride_of(const Document& document, const tinygltf::Accessor& a) {
  const size_t stride = document.model.bufferViews[static_cast<size_t>(a.bufferView)].byteStride;
  return stride > 0 ? stride : element_size(a);
}

const std::byte* bytes_at(const Document& document, int view, size_t offset) {
  return view_bytes(document, view).bytes.data() + offset;
}

template <class T>
T load(const std::byte* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

// Integers that the use wants as fractions, whether the file says so or not.
bool read_as_fraction(const tinygltf::Accessor& a, Use use) {
  const bool integer = a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT;
  const bool fraction = use == Use::color || use == Use::weights || use == Use::normal || use == Use::tangent ||
                        use == Use::morph_direction || use == Use::rotations || use == Use::morph_weights;
  return integer && (a.normalized || fraction);
}

// Section 3.6.2.2: c / 127 for signed integers stops at -1.
template <class T, bool kFraction>
float number_at(const std::byte* p) {
  const auto v = static_cast<float>(load<T>(p));
  if constexpr (kFraction)
    return std::max(v / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
  else
    return v;
}

// `source` gives the address of element i.
template <class T, bool kFraction, class Source>
void convert(Source&& source, size_t count, size_t components, size_t out_stride, float* out) {
  for (size_t i = 0; i < count; ++i, out += out_stride) {
    const std::byte* p = source(i);
    for (size_t c = 0; c < components; ++c) out[c] = number_at<T, kFraction>(p + c * sizeof(T));
  }
}

template <class Source>
void convert(Source&& source, size_t count, const tinygltf::Accessor& a, Use use, size_t out_stride, float* out) {
  const size_t n = components_of(a);
  const bool fraction = read_as_fraction(a, use);
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

// Calls replace(index, address) for every sparse value.
template <class Replace>
void for_each_sparse(const Document& document, const tinygltf::Accessor& a, const std::string& where,
                     Replace&& replace) {
  if (!a.sparse.isSparse) return;
  const auto& indices = a.sparse.indices;
  const std::byte* index = bytes_at(document, indices.bufferView, static_cast<size_t>(indices.byteOffset));
  const std::byte* value =
      bytes_at(document, a.sparse.values.bufferView, static_cast<size_t>(a.sparse.values.byteOffset));
  for (int k = 0; k < a.sparse.count; ++k) {
    const uint32_t i = integer_at(index, indices.componentType);
    if (i >= a.count)
      fail(where, "a sparse index is " + std::to_string(i) + ", but the accessor has " + std::to_string(a.count) +
                      " elements");
    replace(i, value);
    index += component_size(indices.componentType), value += element_size(a);
  }
}

// All elements into zeroed floats, `out_stride` apart.
void read_all(const Document& document, const tinygltf::Accessor& a, Use use, size_t out_stride, float* out,
              const std::string& where) {
  if (a.bufferView >= 0) {
    const std::byte* first = bytes_at(document, a.bufferView, a.byteOffset);
    const size_t stride = stride_of(document, a), size = element_size(a);
    const bool packed =
        a.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT && stride == size && out_stride * sizeof(float) == size;
    if (packed && a.count > 0)
      std::memcpy(out, first, a.count * size);
    else
      convert([&](size_t i) { return first + i * stride; }, a.count, a, use, out_stride, out);
  }
  for_each_sparse(document, a, where, [&](uint32_t i, const std::byte* value) {
    convert([&](size_t) { return value; }, 1, a, use, out_stride, out + i * out_stride);
  });
}

template <class V>
std::vector<V> read_vectors(const Document& document, int index, Use use, Selection selection, const V& filling,
                            const std::string& where) {
  const auto& a = accessor_of(document, index);
  constexpr auto kComponents = static_cast<size_t>(sizeof(V) / sizeof(float));
  const size_t count = selection && !a.sparse.isSparse ? selection->size() : a.count;
  claim(document, count * sizeof(V), where);
  std::vector<V> values;
  values.reserve(count + 1);
  values.resize(count, filling);
  if (count == 0) return values;
  auto* out = reinterpret_cast<float*>(values.data());
  if (!selection || a.sparse.isSparse) {
    read_all(document, a, use, kComponents, out, where);
  } else if (a.bufferView >= 0) {
    const std::byte* first = bytes_at(document, a.bufferView, a.byteOffset);
    const size_t stride = stride_of(document, a);
    convert([&](size_t i) { return first + (*selection)[i] * stride; }, count, a, use, kComponents, out);
  }
  if (!selection || !a.sparse.isSparse) return values;
  std::vector<V> chosen;
  chosen.reserve(selection->size() + 1);
  for (const uint32_t i : *selection) chosen.push_back(values[i]);
  return chosen;
}

}  // namespace

size_t count_of(const Document& document, int accessor) { return accessor_of(document, accessor).count; }

std::vector<Vec2> read_vec2(const Document& document, int accessor, Use use, Selection selection,
                            const std::string& where) {
  return read_vectors(document, accessor, use, selection, Vec2(0), where);
}
std::vector<Vec3> read_vec3(const Document& document, int accessor, Use use, Selection selection,
                            const std::string& where) {
  return read_vectors(document, accessor, use, selection, Vec3(0), where);
}
std::vector<Vec4> read_vec4(const Document& document, int accessor, Use use, Selection selection,
                            const std::string& where) {
  const bool three = components_of(accessor_of(document, accessor)) == 3;
  return read_vectors(document, accessor, use, selection, Vec4(0, 0, 0, three ? 1 : 0), where);
}
std::vector<Mat4> read_matrices(const Document& document, int accessor, const std::string& where) {
  return read_vectors(document, accessor, Use::matrices, nullptr, Mat4(0), where);
}

std::vector<float> read_floats(const Document& document, int index, Use use, const std::string& where) {
  const auto& a = accessor_of(document, index);
  const size_t components = components_of(a);
  claim(document, a.count * components * sizeof(float), where);
  std::vector<float> values(a.count * components);
  read_all(document, a, use, components, values.data(), where);
  return values;
}

std::vector<std::array<uint16_t, 4>> read_joints(const Document& document, int index, Selection selection,
                                                 const std::string& where) {
  using Joints = std::array<uint16_t, 4>;
  const auto& a = accessor_of(document, index);
  // Sparse values are named by their place in the whole accessor.
  const bool choose = selection && !a.sparse.isSparse;
  const size_t count = choose ? selection->size() : a.count;
  claim(document, count * sizeof(Joints), where);
  std::vector<Joints> joints(count);
  const auto set = [&](size_t i, const std::byte* p) {
    for (size_t c = 0; c < 4; ++c)
      joints[i][c] = static_cast<uint16_t>(integer_at(p + c * component_size(a.componentType), a.componentType));
  };
  if (a.bufferView >= 0 && count > 0) {
    const std::byte* first = bytes_at(document, a.bufferView, a.byteOffset);
    const size_t stride = stride_of(document, a);
    for (size_t i = 0; i < count; ++i) set(i, first + (choose ? (*selection)[i] : i) * stride);
  }
  for_each_sparse(document, a, where, set);
  if (!selection || choose) return joints;
  std::vector<Joints> chosen;
  for (const uint32_t i : *selection) chosen.push_back(joints[i]);
  return chosen;
}

void read_indices(const Document& document, int index, std::span<uint32_t> out, const std::string& where) {
  const auto& a = accessor_of(document, index);
  assert(out.size() <= a.count);
  std::fill(out.begin(), out.end(), 0);
  if (a.bufferView >= 0 && !out.empty()) {
    const std::byte* first = bytes_at(document, a.bufferView, a.byteOffset);
    const size_t stride = stride_of(document, a);
    if (a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT && stride == sizeof(uint32_t))
      std::memcpy(out.data(), first, out.size_bytes());
    else
      for (size_t i = 0; i < out.size(); ++i) out[i] = integer_at(first + i * stride, a.componentType);
  }
  for_each_sparse(document, a, where, [&](uint32_t i, const std::byte* p) {
    if (i < out.size()) out[i] = integer_at(p, a.componentType);
  });
}

}  // namespace etendue::scene::gltf
