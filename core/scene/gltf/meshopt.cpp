#include "scene/gltf/meshopt.h"

#include <meshoptimizer.h>

namespace etendue::scene::gltf {
namespace {

using nlohmann::json;

constexpr uint64_t kMost = uint64_t{1} << 53;

uint64_t integer(const json& object, const char* member, const std::string& where, bool needed = true) {
  const auto found = object.find(member);
  if (found == object.end() && !needed) return 0;
  if (found == object.end() || !found->is_number_unsigned() || found->get<uint64_t>() > kMost)
    fail(where, std::string(member) + " has to be there and to be a whole number that is not negative");
  return found->get<uint64_t>();
}

// The place of a word in the list; anything else is unusable.
template <class E>
E word(const json& object, const char* member, std::initializer_list<const char*> words, const std::string& where) {
  const auto found = object.find(member);
  std::string list;
  size_t place = 0;
  for (const char* known : words) {
    if (found != object.end() && *found == known) return static_cast<E>(place);
    list += (place++ ? ", " : "") + std::string(known);
  }
  fail(where, std::string(member) + " has to be one of " + list);
}

bool stride_fits(const Meshopt& m) {
  if (m.mode != Meshopt::Mode::attributes) return m.stride == 2 || m.stride == 4;
  switch (m.filter) {
    case Meshopt::Filter::octahedral:
      return m.stride == 4 || m.stride == 8;
    case Meshopt::Filter::quaternion:
      return m.stride == 8;
    default:
      return m.stride > 0 && m.stride % 4 == 0 && m.stride <= 256;
  }
}

void apply(Meshopt::Filter filter, void* values, size_t count, size_t stride) {
  switch (filter) {
    case Meshopt::Filter::none:
      return;
    case Meshopt::Filter::octahedral:
      return meshopt_decodeFilterOct(values, count, stride);
    case Meshopt::Filter::quaternion:
      return meshopt_decodeFilterQuat(values, count, stride);
    case Meshopt::Filter::exponential:
      return meshopt_decodeFilterExp(values, count, stride);
  }
}

}  // namespace

Meshopt read_meshopt(const json& extension, const std::string& where) {
  Meshopt m;
  m.buffer = integer(extension, "buffer", where), m.offset = integer(extension, "byteOffset", where, false);
  m.length = integer(extension, "byteLength", where);
  m.stride = integer(extension, "byteStride", where), m.count = integer(extension, "count", where);
  m.mode = word<Meshopt::Mode>(extension, "mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"}, where);
  if (extension.contains("filter"))
    m.filter = word<Meshopt::Filter>(extension, "filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}, where);
  if (m.mode != Meshopt::Mode::attributes && m.filter != Meshopt::Filter::none)
    fail(where, "has a filter, which only attributes can have");
  if (!stride_fits(m)) fail(where, "byteStride " + std::to_string(m.stride) + " is not possible in its mode");
  if (m.mode == Meshopt::Mode::triangles && m.count % 3 != 0)
    fail(where, "count " + std::to_string(m.count) + " has to be a multiple of three for triangles");
  return m;
}

std::vector<std::byte> decode_meshopt(const Document& document, const Meshopt& m, Bytes compressed,
                                      const std::string& where) {
  if (m.count > kMost / 256) fail(where, "count " + std::to_string(m.count) + " cannot be meant");
  claim(document, m.stride * m.count, where);
  std::vector<std::byte> out(m.stride * m.count);
  const auto* in = reinterpret_cast<const unsigned char*>(compressed.data());
  const auto decode = [&] {
    switch (m.mode) {
      case Meshopt::Mode::attributes:
        return meshopt_decodeVertexBuffer(out.data(), m.count, m.stride, in, compressed.size());
      case Meshopt::Mode::triangles:
        return meshopt_decodeIndexBuffer(out.data(), m.count, m.stride, in, compressed.size());
      default:
        return meshopt_decodeIndexSequence(out.data(), m.count, m.stride, in, compressed.size());
    }
  };
  if (m.count > 0 && decode() != 0)
    fail(where, "its " + std::to_string(compressed.size()) + " bytes are damaged; they are not " +
                    std::to_string(m.count) + " elements of " + std::to_string(m.stride) + " bytes");
  apply(m.filter, out.data(), m.count, m.stride);
  return out;
}

}  // namespace etendue::scene::gltf
