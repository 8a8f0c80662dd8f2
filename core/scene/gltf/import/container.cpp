#include "scene/gltf/import/container.h"

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

// The file without trailing bytes. GLB of version 1 has the same magic number and another layout.
Bytes checked_body(Bytes file, std::vector<std::string>& warnings) {
  if (file.size() < kHeader)
    throw FileError{"truncated: a GLB header has 12 bytes, but the file has " + number(file.size())};
  const uint32_t version = word_at(file, 4), length = word_at(file, 8);
  if (version != 2) throw FileError{"GLB version " + number(version) + " is not supported, only version 2 is"};
  if (length > file.size())
    throw FileError{"truncated: the GLB header declares " + number(length) + " bytes, but the file has " +
                    number(file.size())};
  if (length < kHeader + kChunkHeader)
    throw FileError{"the GLB header declares " + number(length) + " bytes; a header and one chunk need at least 20"};
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
    if (length > left)
      fail(where, "declares " + number(length) + " bytes, but only " + number(left) + " remain in the file");
    const Bytes content = body.subspan(offset + kChunkHeader, length);
    if ((chunk == 0) != (type == kJsonChunk))
      fail(where, chunk == 0 ? "is not JSON; the first chunk of a GLB has to be JSON"
                             : "is a second JSON chunk; only one is allowed");
    if (chunk == 0) container.json = text(content);
    // glTF 2.0, section 4.4.3.3: the binary chunk is the second one; chunks of other types are ignored.
    if (chunk == 1 && type == kBinaryChunk) {
      container.binary = content;
      container.has_binary = true;
    }
    offset += kChunkHeader + length;
  }
  return container;
}

}  // namespace etendue::scene::gltf
