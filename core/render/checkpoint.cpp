#include "render/checkpoint.h"

#include <cstring>
#include <vector>

#include "base/file.h"
#include "base/hash.h"

namespace etendue::render {
namespace {

constexpr char kMagic[8] = {'E', 'T', 'D', 'C', 'K', 'P', 'T', '1'};

// The fixed part at the front. Everything after it is: the state text, the pixels and the first rejections as they
// stand in memory.
struct Header {
  char magic[8];
  uint64_t state_size;
  int32_t width, height;
  uint64_t nan, infinite, negative;
  double seconds;
  uint64_t hash;  // of all bytes behind the header
};

Error damaged(const std::filesystem::path& path, const char* what) {
  return input_error(path.string() + ": " + what + "; give a file that --checkpoint wrote");
}

}  // namespace

Result<void> write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  const film::Rejected rejected = checkpoint.film.rejected();
  const auto pixels = std::as_bytes(checkpoint.film.pixels()), first = std::as_bytes(std::span(rejected.first));
  std::vector<char> bytes(sizeof(Header) + checkpoint.state.size() + pixels.size() + first.size());
  char* body = bytes.data() + sizeof(Header);
  std::memcpy(body, checkpoint.state.data(), checkpoint.state.size());
  std::memcpy(body + checkpoint.state.size(), pixels.data(), pixels.size());
  if (!first.empty()) std::memcpy(body + checkpoint.state.size() + pixels.size(), first.data(), first.size());
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.state_size = checkpoint.state.size();
  header.width = checkpoint.film.width(), header.height = checkpoint.film.height();
  header.nan = rejected.nan, header.infinite = rejected.infinite, header.negative = rejected.negative;
  header.seconds = checkpoint.seconds;
  header.hash = hash_bytes(body, bytes.size() - sizeof(Header));
  std::memcpy(bytes.data(), &header, sizeof header);
  return write_file(path, bytes.data(), bytes.size());
}

Result<Checkpoint> read_checkpoint(const std::filesystem::path& path) {
  auto read = read_file(path);
  if (!read) return read.error();
  const auto& bytes = *read;
  Header header;
  if (bytes.size() < sizeof header) return damaged(path, "it is too short to be a checkpoint");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0) return damaged(path, "this is no checkpoint");
  const uint64_t body = bytes.size() - sizeof header;
  constexpr int32_t kMost = 1 << 16;
  if (header.width <= 0 || header.height <= 0 || header.width > kMost || header.height > kMost ||
      header.state_size > body)
    return damaged(path, "its size makes no sense");
  const uint64_t pixels =
      static_cast<uint64_t>(header.width) * static_cast<uint64_t>(header.height) * sizeof(film::Film::Pixel);
  if (body < header.state_size + pixels) return damaged(path, "it is truncated");
  const uint64_t first = body - header.state_size - pixels;
  if (first % sizeof(film::Rejection) != 0 || first > film::kFirstRejections * sizeof(film::Rejection))
    return damaged(path, "it is truncated");
  const char* data = reinterpret_cast<const char*>(bytes.data()) + sizeof header;
  if (hash_bytes(data, body) != header.hash) return damaged(path, "it is damaged");

  Checkpoint checkpoint;
  checkpoint.state.assign(data, header.state_size);
  checkpoint.seconds = header.seconds;
  checkpoint.film = film::Film(header.width, header.height);
  film::Rejected rejected{header.nan, header.infinite, header.negative, {}};
  rejected.first.resize(first / sizeof(film::Rejection));
  if (first > 0) std::memcpy(rejected.first.data(), data + header.state_size + pixels, first);
  checkpoint.film.set_rejected(rejected);
  std::memcpy(checkpoint.film.pixels().data(), data + header.state_size, pixels);
  return checkpoint;
}

}  // namespace etendue::render
