#include "scene/gltf/import/meshopt_decoder.h"

#include <meshoptimizer.h>

namespace etendue::scene::gltf {
namespace {

using nlohmann::json;

constexpr uint64_t kMaxInteger = uint64_t{1} << 53;

uint64_t integer(const json& object, const char* member, const std::string& where, bool required = true) {
  const auto found = object.find(member);
  if (found == object.end() && !required) return 0;
  if (found == object.end() || !found->is_number_unsigned() || found->get<uint64_t>() > kMaxInteger)
    fail(where, std::string(member) + " has to be an integer between 0 and 9007199254740992");
  return found->get<uint64_t>();
}

// The enumerator whose name in the list is the member's value.
template <class E>
E enumerator(const json& object, const char* member, std::initializer_list<const char*> names,
             const std::string& where) {
  const auto found = object.find(member);
  std::string list;
  size_t index = 0;
  for (const char* name : names) {
    if (found != object.end() && *found == name) return static_cast<E>(index);
    list += (index > 0 ? ", " : "") + std::string(name);
    ++index;
  }
  fail(where, std::string(member) + " has to be one of " + list);
}

bool stride_fits(const MeshoptView& m) {
  if (m.mode != MeshoptView::Mode::attributes) return m.stride == 2 || m.stride == 4;
  switch (m.filter) {
    case MeshoptView::Filter::octahedral:
      return m.stride == 4 || m.stride == 8;
    case MeshoptView::Filter::quaternion:
      return m.stride == 8;
    default:
      return m.stride > 0 && m.stride % 4 == 0 && m.stride <= 256;
  }
}

void apply(MeshoptView::Filter filter, void* values, size_t count, size_t stride) {
  switch (filter) {
    case MeshoptView::Filter::none:
      return;
    case MeshoptView::Filter::octahedral:
      return meshopt_decodeFilterOct(values, count, stride);
    case MeshoptView::Filter::quaternion:
      return meshopt_decodeFilterQuat(values, count, stride);
    case MeshoptView::Filter::exponential:
      return meshopt_decodeFilterExp(values, count, stride);
  }
}

}  // namespace

MeshoptView read_meshopt_view(const json& extension, const std::string& where) {
  MeshoptView m;
  m.buffer = integer(extension, "buffer", where);
  m.offset = integer(extension, "byteOffset", where, false);
  m.length = integer(extension, "byteLength", where);
  m.stride = integer(extension, "byteStride", where);
  m.count = integer(extension, "count", where);
  m.mode = enumerator<MeshoptView::Mode>(extension, "mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"}, where);
  if (extension.contains("filter"))
    m.filter = enumerator<MeshoptView::Filter>(extension, "filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"},
                                               where);
  if (m.mode != MeshoptView::Mode::attributes && m.filter != MeshoptView::Filter::none)
    fail(where, "has a filter, which only mode ATTRIBUTES allows");
  if (!stride_fits(m)) fail(where, "byteStride " + std::to_string(m.stride) + " is not allowed in this mode");
  if (m.mode == MeshoptView::Mode::triangles && m.count % 3 != 0)
    fail(where, "count " + std::to_string(m.count) + " has to be a multiple of 3 in mode TRIANGLES");
  return m;
}

std::vector<std::byte> decode_meshopt(const InputFile& input, const MeshoptView& m, Bytes compressed,
                                      const std::string& where) {
  if (m.count > kMaxInteger / 256) fail(where, "count " + std::to_string(m.count) + " is too large");
  check_memory(input, m.stride * m.count, where);
  std::vector<std::byte> out(m.stride * m.count);
  const auto* in = reinterpret_cast<const unsigned char*>(compressed.data());
  const auto decode = [&] {
    switch (m.mode) {
      case MeshoptView::Mode::attributes:
        return meshopt_decodeVertexBuffer(out.data(), m.count, m.stride, in, compressed.size());
      case MeshoptView::Mode::triangles:
        return meshopt_decodeIndexBuffer(out.data(), m.count, m.stride, in, compressed.size());
      default:
        return meshopt_decodeIndexSequence(out.data(), m.count, m.stride, in, compressed.size());
    }
  };
  if (m.count > 0 && decode() != 0)
    fail(where, "the " + std::to_string(compressed.size()) + " compressed bytes are damaged; they do not decode to " +
                    std::to_string(m.count) + " elements of " + std::to_string(m.stride) + " bytes");
  apply(m.filter, out.data(), m.count, m.stride);
  return out;
}

}  // namespace etendue::scene::gltf
