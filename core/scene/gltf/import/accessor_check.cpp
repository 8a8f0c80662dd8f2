// Checks of accessors: the types that each use allows, and that all elements lie inside their buffer views.
#include <bit>

#include "scene/gltf/import/accessor.h"

namespace etendue::scene::gltf {
namespace {

// Component types as a bit mask.
enum : uint8_t { kByte = 1, kUByte = 2, kShort = 4, kUShort = 8, kUInt = 16, kFloat = 32 };
constexpr uint8_t kSmall = kByte | kUByte | kShort | kUShort, kSmallUnsigned = kUByte | kUShort,
                  kSmallSigned = kByte | kShort;

// Element types as a bit mask.
enum : uint8_t { kScalar = 1, kVec2 = 2, kVec3 = 4, kVec4 = 8, kMat4 = 16 };

struct AllowedTypes {
  uint8_t types;
  uint8_t plain, fraction;                      // component types by the specification: not normalised, normalised
  uint8_t quantized_plain, quantized_fraction;  // additional component types by KHR_mesh_quantization
  const char* text;                             // for messages
};

const AllowedTypes& allowed_types(AccessorUse use) {
  // One line per AccessorUse, in its order.
  static constexpr AllowedTypes kAllowed[] = {
      {kVec3, kFloat, 0, kSmall, kSmall, "VEC3 of floats"},
      {kVec3, kFloat, 0, 0, kSmallSigned, "VEC3 of floats"},
      {kVec4, kFloat, 0, 0, kSmallSigned, "VEC4 of floats"},
      {kVec2, kFloat, kSmallUnsigned, kSmall, kSmallSigned, "VEC2 of floats or normalized unsigned integers"},
      {kVec3 | kVec4, kFloat, kSmallUnsigned, 0, 0, "VEC3 or VEC4 of floats or normalized unsigned integers"},
      {kVec4, kSmallUnsigned, 0, 0, 0, "VEC4 of unsigned bytes or shorts"},
      {kVec4, kFloat, kSmallUnsigned, 0, 0, "VEC4 of floats or normalized unsigned integers"},
      {kVec3, kFloat, 0, kSmallSigned, kSmallSigned, "VEC3 of floats"},
      {kVec3, kFloat, 0, 0, kSmallSigned, "VEC3 of floats"},
      {kScalar, kSmallUnsigned | kUInt, 0, 0, 0, "SCALAR of unsigned integers"},
      {kMat4, kFloat, 0, 0, 0, "MAT4 of floats"},
      {kScalar, kFloat, 0, 0, 0, "SCALAR of floats"},
      {kVec3, kFloat, 0, 0, 0, "VEC3 of floats"},
      {kVec4, kFloat, kSmall, 0, 0, "VEC4 of floats or normalized integers"},
      {kScalar, kFloat, kSmall, 0, 0, "SCALAR of floats or normalized integers"},
  };
  return kAllowed[static_cast<size_t>(use)];
}

uint8_t type_bit(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return kScalar;
    case TINYGLTF_TYPE_VEC2:
      return kVec2;
    case TINYGLTF_TYPE_VEC3:
      return kVec3;
    case TINYGLTF_TYPE_VEC4:
      return kVec4;
    case TINYGLTF_TYPE_MAT4:
      return kMat4;
    default:
      return 0;
  }
}

uint8_t component_bit(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return kByte;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return kUByte;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return kShort;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return kUShort;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return kUInt;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return kFloat;
    default:
      return 0;
  }
}

std::string kind_of(const tinygltf::Accessor& a) {
  static constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT4"};
  static constexpr const char* kComponents[] = {"bytes",           "unsigned bytes", "shorts",
                                                "unsigned shorts", "unsigned ints",  "floats"};
  const uint8_t type = type_bit(a.type), component = component_bit(a.componentType);
  const std::string name = type ? kTypes[std::countr_zero(type)] : "MAT2 or MAT3";
  if (!component) return name + " of component type " + std::to_string(a.componentType);
  return name + " of " + (a.normalized ? "normalized " : "") + kComponents[std::countr_zero(component)];
}

// What is wrong if `count` elements of `size` bytes, `stride` bytes apart, do not end inside the view; empty if they
// do.
std::string range_problem(const InputFile& input, const std::string& name, int view, uint64_t offset, uint64_t count,
                          uint64_t size, uint64_t stride) {
  const ViewBytes bytes = view_bytes(input, view);
  if (!bytes.problem.empty()) return bytes.problem;
  const uint64_t length = bytes.bytes.size();
  const uint64_t fitting = offset > length || size > length - offset ? 0 : (length - offset - size) / stride + 1;
  if (count <= fitting) return "";
  const std::string in_view = ", but bufferView " + std::to_string(view) + " has " + std::to_string(length);
  if (count - 1 > (uint64_t{1} << 60) / stride)
    return name + " has a count of " + std::to_string(count) + in_view + " bytes; at most " + std::to_string(fitting) +
           " fit";
  return name + " ends at byte " + std::to_string(offset + (count - 1) * stride + size) + in_view + "; at most " +
         std::to_string(fitting) + " elements fit";
}

std::string sparse_problem(const InputFile& input, const tinygltf::Accessor& a, const std::string& name,
                           uint64_t size) {
  const auto& sparse = a.sparse;
  if (sparse.count < 0 || static_cast<uint64_t>(sparse.count) > a.count)
    return name + " has " + std::to_string(sparse.count) + " sparse values for " + std::to_string(a.count) +
           " elements";
  const uint8_t index_type = component_bit(sparse.indices.componentType);
  if (!(index_type & (kSmallUnsigned | kUInt))) return name + " has sparse indices that are not unsigned integers";
  const uint64_t index_size = component_size(sparse.indices.componentType);
  const auto count = static_cast<uint64_t>(sparse.count);
  std::string problem = range_problem(input, name + " (sparse indices)", sparse.indices.bufferView,
                                      static_cast<uint64_t>(sparse.indices.byteOffset), count, index_size, index_size);
  if (problem.empty())
    problem = range_problem(input, name + " (sparse values)", sparse.values.bufferView,
                            static_cast<uint64_t>(sparse.values.byteOffset), count, size, size);
  return problem;
}

bool declares(const InputFile& input, const char* extension) {
  const auto& used = input.model.extensionsUsed;
  return std::find(used.begin(), used.end(), extension) != used.end();
}

}  // namespace

std::string accessor_problem(const InputFile& input, int accessor) {
  const auto& accessors = input.model.accessors;
  const std::string name = "accessor " + std::to_string(accessor);
  if (accessor < 0 || static_cast<size_t>(accessor) >= accessors.size())
    return name + " does not exist; the file has " + std::to_string(accessors.size());
  const auto& a = accessors[static_cast<size_t>(accessor)];
  if (!component_bit(a.componentType))
    return name + " has component type " + std::to_string(a.componentType) + ", which does not exist in glTF";
  const uint64_t size = component_size(a.componentType) *
                        static_cast<uint64_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type)));
  if (a.bufferView >= 0) {
    uint64_t stride = size;
    if (static_cast<size_t>(a.bufferView) < input.model.bufferViews.size())
      if (const size_t declared = input.model.bufferViews[static_cast<size_t>(a.bufferView)].byteStride; declared > 0)
        stride = declared;
    if (stride < size)
      return name + " has elements of " + std::to_string(size) + " bytes, but the byteStride of bufferView " +
             std::to_string(a.bufferView) + " is " + std::to_string(stride);
    if (std::string problem = range_problem(input, name, a.bufferView, a.byteOffset, a.count, size, stride);
        !problem.empty())
      return problem;
  } else if (a.bufferView < -1) {
    return name + " has bufferView " + std::to_string(a.bufferView);
  }
  return a.sparse.isSparse ? sparse_problem(input, a, name, size) : "";
}

void check_accessor(InputFile& input, int accessor, AccessorUse use, const std::string& where) {
  if (std::string problem = accessor_problem(input, accessor); !problem.empty()) fail(where, problem);
  const auto& a = input.model.accessors[static_cast<size_t>(accessor)];
  const AllowedTypes& rule = allowed_types(use);
  const uint8_t component = component_bit(a.componentType);
  const bool fraction = a.normalized && component != kFloat && component != kUInt;
  const uint8_t by_specification = fraction ? rule.fraction : rule.plain;
  const uint8_t by_extension = fraction ? rule.quantized_fraction : rule.quantized_plain;
  const std::string is = "accessor " + std::to_string(accessor) + " is " + kind_of(a);
  if (!(type_bit(a.type) & rule.types)) fail(where, is + "; " + rule.text + " is required");
  if (component & by_specification) return;
  if (component & by_extension) {
    if (!declares(input, "KHR_mesh_quantization"))
      input.warnings.push_back(where + ": " + is + ", but extensionsUsed does not list KHR_mesh_quantization");
    return;
  }
  if (!fraction && (component & (rule.fraction | rule.quantized_fraction))) {
    input.warnings.push_back(where + ": " + is + "; it is read as if normalized were true");
    return;
  }
  fail(where, is + "; " + rule.text + " is required");
}

}  // namespace etendue::scene::gltf
