#include "scene/gltf/container.h"

#include <cstring>

namespace etendue::scene::gltf {
namespace {

constexpr uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
constexpr size_t kHeader = 12, kChunkHeader = 8;

uint32_t word_at(Bytes bytes, size_t offset) {
  uint32_t word;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

std::string number(uint64_t n) { return std::to_string(n); }

// A binary glTF of version 1 has the same magic number and another layout.
Bytes checked_body(Bytes file, std::vector<std::string>& warnings) {
  if (file.size() < kHeader)
    throw Unusable{"is cut off: a GLB begins with a header of 12 bytes, the file has " + number(file.size())};
  const uint32_t version = word_at(file, 4), length = word_at(file, 8);
  if (version != 2) throw Unusable{"is a GLB of version " + number(version) + "; version 2 is what can be read"};
  if (length > file.size())
    throw Unusable{"is cut off: the GLB header claims " + number(length) + " bytes, the file has " +
                   number(file.size())};
  if (length < kHeader + kChunkHeader)
    throw Unusable{"the GLB header claims " + number(length) + " bytes; a header and one chunk need at least 20"};
  if (length < file.size())
    warnings.push_back(number(file.size() - length) + " bytes after the end of the GLB are ignored");
  return file.first(length);
}

}  // namespace

Container split_container(Bytes file, std::vector<std::string>& warnings) {
  Container container;
  const auto text = [](Bytes b) { return std::string_view(reinterpret_cast<const char*>(b.data()), b.size()); };
  if (!text(file).starts_with("glTF")) {
    container.json = text(file);
    return container;
  }
  const Bytes body = checked_body(file, warnings);
  size_t offset = kHeader;
  for (int chunk = 0; offset < body.size(); ++chunk) {
    const std::string where = "chunk " + std::to_string(chunk);
    if (body.size() - offset < kChunkHeader) {
      warnings.push_back(number(body.size() - offset) + " bytes after the last chunk are ignored");
      break;
    }
    const uint32_t length = word_at(body, offset), type = word_at(body, offset + 4);
    const size_t left = body.size() - offset - kChunkHeader;
    if (length > left) fail(where, "claims " + number(length) + " bytes, but only " + number(left) + " are left");
    const Bytes content = body.subspan(offset + kChunkHeader, length);
    if ((chunk == 0) != (type == kJsonChunk))
      fail(where,
           chunk == 0 ? "is no JSON; a GLB begins with a chunk of JSON" : "is a second one of JSON; there can be one");
    if (chunk == 0) container.json = text(content);
    // Section 4.4.3.3: the binary chunk is the second; clients ignore chunks of other types.
    if (chunk == 1 && type == kBinaryChunk) container.binary = content, container.has_binary = true;
    offset += kChunkHeader + length;
  }
  return container;
}

}  // namespace etendue::scene::gltf
