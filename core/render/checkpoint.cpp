#include "render/checkpoint.h"

#include <cstddef>
#include <cstring>
#include <vector>

#include "base/file.h"
#include "base/hash.h"

namespace etendue::render {
namespace {

constexpr char kMagic[8] = {'E', 'T', 'D', 'C', 'K', 'P', 'T', '3'};
constexpr char kMagicBefore[8] = {'E', 'T', 'D', 'C', 'K', 'P', 'T', '2'};

// The fixed part at the front. Everything after it is: the state text, the pixels, what adaptive sampling knows of
// blocks, the state of the method, and the first rejections, as they stand in memory.
struct Header {
  char magic[8];
  uint64_t state_size;
  int32_t width, height;
  uint64_t nan, infinite, negative;
  double seconds;
  uint64_t spread_blocks;
  uint64_t hash;       // of all bytes behind the header
  uint64_t work_size;  // not in the version before
};

Error damaged(const std::filesystem::path& path, const char* what) {
  return input_error(path.string() + ": " + what + "; give a file that --checkpoint wrote");
}

void append(std::vector<char>& bytes, std::span<const std::byte> part) {
  const auto* begin = reinterpret_cast<const char*>(part.data());
  bytes.insert(bytes.end(), begin, begin + part.size());
}

}  // namespace

Result<void> write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  const film::InvalidSamples rejected = checkpoint.film.rejected();
  const auto& spread = checkpoint.film.tile_variance();
  const std::span<const std::byte> parts[] = {
      std::as_bytes(std::span(checkpoint.state)), std::as_bytes(checkpoint.film.pixels()),
      spread ? spread->bytes() : std::span<const std::byte>(), std::span(checkpoint.integrator_state),
      std::as_bytes(std::span(rejected.first))};
  std::vector<char> bytes(sizeof(Header));
  for (const auto& part : parts) append(bytes, part);
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.state_size = checkpoint.state.size();
  header.width = checkpoint.film.width(), header.height = checkpoint.film.height();
  header.nan = rejected.nan, header.infinite = rejected.infinite, header.negative = rejected.negative;
  header.seconds = checkpoint.seconds;
  header.spread_blocks = spread ? spread->blocks() : 0;
  header.work_size = checkpoint.integrator_state.size();
  header.hash = hash_bytes(bytes.data() + sizeof(Header), bytes.size() - sizeof(Header));
  std::memcpy(bytes.data(), &header, sizeof header);
  return write_file(path, bytes.data(), bytes.size());
}

Result<Checkpoint> read_checkpoint(const std::filesystem::path& path) {
  auto read = read_file(path);
  if (!read) return read.error();
  const auto& bytes = *read;
  Header header{};
  if (bytes.size() < sizeof header) return damaged(path, "it is too short to be a checkpoint");
  const bool before = std::memcmp(bytes.data(), kMagicBefore, sizeof kMagicBefore) == 0;
  const size_t header_size = before ? offsetof(Header, work_size) : sizeof header;
  std::memcpy(&header, bytes.data(), header_size);
  if (!before && std::memcmp(header.magic, kMagic, sizeof kMagic) != 0) return damaged(path, "this is no checkpoint");
  const uint64_t body = bytes.size() - header_size;
  constexpr int32_t kMost = 1 << 16;
  if (header.width <= 0 || header.height <= 0 || header.width > kMost || header.height > kMost ||
      header.state_size > body || header.work_size > body ||
      header.spread_blocks > body / film::TileVariance::kBytesOfBlock)
    return damaged(path, "its size makes no sense");
  const uint64_t pixels =
      static_cast<uint64_t>(header.width) * static_cast<uint64_t>(header.height) * sizeof(film::Film::Pixel);
  const uint64_t spread = header.spread_blocks * film::TileVariance::kBytesOfBlock;
  if (body < header.state_size + pixels + spread + header.work_size) return damaged(path, "it is truncated");
  const uint64_t first = body - header.state_size - pixels - spread - header.work_size;
  if (first % sizeof(film::Rejection) != 0 || first > film::kFirstRejections * sizeof(film::Rejection))
    return damaged(path, "it is truncated");
  const char* data = reinterpret_cast<const char*>(bytes.data()) + header_size;
  if (hash_bytes(data, body) != header.hash) return damaged(path, "it is damaged");

  Checkpoint checkpoint;
  checkpoint.state.assign(data, header.state_size);
  checkpoint.seconds = header.seconds;
  checkpoint.film = film::Film(header.width, header.height);
  std::memcpy(checkpoint.film.pixels().data(), data + header.state_size, pixels);
  data += header.state_size + pixels;
  if (spread > 0) {
    checkpoint.film.begin_tile_variance(header.spread_blocks);
    std::memcpy(checkpoint.film.tile_variance()->bytes().data(), data, spread);
    data += spread;
  }
  checkpoint.integrator_state.resize(header.work_size);
  if (header.work_size > 0) std::memcpy(checkpoint.integrator_state.data(), data, header.work_size);
  data += header.work_size;
  film::InvalidSamples rejected{header.nan, header.infinite, header.negative, {}};
  rejected.first.resize(first / sizeof(film::Rejection));
  if (first > 0) std::memcpy(rejected.first.data(), data, first);
  checkpoint.film.set_invalid_samples(rejected);
  return checkpoint;
}

}  // namespace etendue::render
