// What each use of an accessor allows, and whether its elements lie where they are said to.
#include <bit>

#include "scene/gltf/accessor.h"

namespace etendue::scene::gltf {
namespace {

// Component types as bits.
enum : uint8_t { kByte = 1, kUByte = 2, kShort = 4, kUShort = 8, kUInt = 16, kFloat = 32 };
constexpr uint8_t kSmall = kByte | kUByte | kShort | kUShort, kSmallUnsigned = kUByte | kUShort,
                  kSmallSigned = kByte | kShort;

// Types as bits.
enum : uint8_t { kScalar = 1, kVec2 = 2, kVec3 = 4, kVec4 = 8, kMat4 = 16 };

struct Allowed {
  uint8_t types;
  uint8_t plain, fraction;                      // by the specification: as they are, and normalised
  uint8_t quantized_plain, quantized_fraction;  // besides, by KHR_mesh_quantization
  const char* text;
};

const Allowed& allowed(Use use) {
  static constexpr Allowed kAllowed[] = {
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

uint64_t component_size(int type) {
  return static_cast<uint64_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(type)));
}

// `count` elements of `size` bytes, `stride` apart, have to end inside the view.
std::string run_problem(const Document& document, const std::string& name, int view, uint64_t offset, uint64_t count,
                        uint64_t size, uint64_t stride) {
  const ViewBytes bytes = view_bytes(document, view);
  if (!bytes.problem.empty()) return bytes.problem;
  const uint64_t length = bytes.bytes.size();
  const uint64_t fitting = offset > length || size > length - offset ? 0 : (length - offset - size) / stride + 1;
  if (count <= fitting) return "";
  const std::string in_view = ", but bufferView " + std::to_string(view) + " has " + std::to_string(length);
  if (count - 1 > (uint64_t{1} << 60) / stride)
    return name + " claims " + std::to_string(count) + " elements" + in_view + " bytes; at most " +
           std::to_string(fitting) + " fit";
  return name + " ends at byte " + std::to_string(offset + (count - 1) * stride + size) + in_view + "; at most " +
         std::to_string(fitting) + " elements fit";
}

std::string sparse_problem(const Document& document, const tinygltf::Accessor& a, const std::string& name,
                           uint64_t size) {
  const auto& sparse = a.sparse;
  if (sparse.count < 0 || static_cast<uint64_t>(sparse.count) > a.count)
    return name + " replaces " + std::to_string(sparse.count) + " of " + std::to_string(a.count) + " elements";
  const uint8_t index_type = component_bit(sparse.indices.componentType);
  if (!(index_type & (kSmallUnsigned | kUInt))) return name + " has sparse indices that are no unsigned integers";
  const uint64_t index_size = component_size(sparse.indices.componentType);
  const auto count = static_cast<uint64_t>(sparse.count);
  std::string problem = run_problem(document, name + " (sparse indices)", sparse.indices.bufferView,
                                    static_cast<uint64_t>(sparse.indices.byteOffset), count, index_size, index_size);
  if (problem.empty())
    problem = run_problem(document, name + " (sparse values)", sparse.values.bufferView,
                          static_cast<uint64_t>(sparse.values.byteOffset), count, size, size);
  return problem;
}

bool declares(const Document& document, const char* extension) {
  const auto& used = document.model.extensionsUsed;
  return std::find(used.begin(), used.end(), extension) != used.end();
}

}  // namespace

std::string problem_of(const Document& document, int accessor) {
  const auto& accessors = document.model.accessors;
  const std::string name = "accessor " + std::to_string(accessor);
  if (accessor < 0 || static_cast<size_t>(accessor) >= accessors.size())
    return name + " does not exist; there are " + std::to_string(accessors.size());
  const auto& a = accessors[static_cast<size_t>(accessor)];
  if (!component_bit(a.componentType))
    return name + " has component type " + std::to_string(a.componentType) + ", which glTF does not know";
  const uint64_t size = component_size(a.componentType) *
                        static_cast<uint64_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type)));
  if (a.bufferView >= 0) {
    uint64_t stride = size;
    if (static_cast<size_t>(a.bufferView) < document.model.bufferViews.size())
      if (const size_t wanted = document.model.bufferViews[static_cast<size_t>(a.bufferView)].byteStride; wanted > 0)
        stride = wanted;
    if (stride < size)
      return name + " has elements of " + std::to_string(size) + " bytes, but bufferView " +
             std::to_string(a.bufferView) + " puts them " + std::to_string(stride) + " bytes apart (byteStride)";
    if (std::string problem = run_problem(document, name, a.bufferView, a.byteOffset, a.count, size, stride);
        !problem.empty())
      return problem;
  } else if (a.bufferView < -1) {
    return name + " has bufferView " + std::to_string(a.bufferView);
  }
  return a.sparse.isSparse ? sparse_problem(document, a, name, size) : "";
}

void check_accessor(Document& document, int accessor, Use use, const std::string& where) {
  if (std::string problem = problem_of(document, accessor); !problem.empty()) fail(where, problem);
  const auto& a = document.model.accessors[static_cast<size_t>(accessor)];
  const Allowed& rule = allowed(use);
  const uint8_t component = component_bit(a.componentType);
  const bool fraction = a.normalized && component != kFloat && component != kUInt;
  const uint8_t by_specification = fraction ? rule.fraction : rule.plain;
  const uint8_t by_extension = fraction ? rule.quantized_fraction : rule.quantized_plain;
  const std::string is = "accessor " + std::to_string(accessor) + " is " + kind_of(a);
  if (!(type_bit(a.type) & rule.types)) fail(where, is + "; " + rule.text + " is needed");
  if (component & by_specification) return;
  if (component & by_extension) {
    if (!declares(document, "KHR_mesh_quantization"))
      document.warnings.push_back(where + ": " + is + " without the file naming KHR_mesh_quantization");
    return;
  }
  if (!fraction && (component & (rule.fraction | rule.quantized_fraction))) {
    document.warnings.push_back(where + ": " + is + "; they are read as if normalized were true");
    return;
  }
  fail(where, is + "; " + rule.text + " is needed");
}

}  // namespace etendue::scene::gltf
