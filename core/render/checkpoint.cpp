#include "render/checkpoint.h"

#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "base/file.h"
#include "base/hash.h"
#include "render/tail_statistics.h"

namespace etendue::render {
namespace {

constexpr char kMagic[8] = {'E', 'T', 'D', 'C', 'K', 'P', 'T', '5'};
constexpr char kMagicVersion4[8] = {'E', 'T', 'D', 'C', 'K', 'P', 'T', '4'};
constexpr char kMagicVersion3[8] = {'E', 'T', 'D', 'C', 'K', 'P', 'T', '3'};
constexpr char kMagicVersion2[8] = {'E', 'T', 'D', 'C', 'K', 'P', 'T', '2'};

// The head of the file. It is followed by the state text, the pixels, the tile variances of adaptive sampling, the
// state of the integrator, the rounding errors of the film, the statistics of tails, and the records of the first invalid
// samples, all as they are in memory.
struct Header {
  char magic[8];
  uint64_t state_size;
  int32_t width, height;
  uint64_t nan, infinite, negative;  // numbers of invalid samples
  double seconds;
  uint64_t variance_blocks;
  uint64_t hash;                   // of all bytes after the header
  uint64_t integrator_state_size;  // not in version 2
  uint64_t rounding_errors_size;   // not in versions 2 and 3
  uint64_t tails_size;             // not in versions 2 to 4
};

// The sizes in bytes of the parts after the header.
struct PartSizes {
  uint64_t state, pixels, variance, integrator_state, rounding_errors, tails, invalid_samples;
};

Error damaged(const std::filesystem::path& path, const char* what) {
  return input_error(path.string() + ": " + what + "; give a file that --checkpoint wrote");
}

void append(std::vector<char>& bytes, std::span<const std::byte> part) {
  const auto* begin = reinterpret_cast<const char*>(part.data());
  bytes.insert(bytes.end(), begin, begin + part.size());
}

// The number of bytes of the header in a file that begins with `magic`; 0 if it is not a checkpoint.
size_t header_size_of(const std::byte* magic) {
  const auto begins_with = [&](const char(&text)[8]) { return std::memcmp(magic, text, sizeof text) == 0; };
  if (begins_with(kMagic)) return sizeof(Header);
  if (begins_with(kMagicVersion4)) return offsetof(Header, tails_size);
  if (begins_with(kMagicVersion3)) return offsetof(Header, rounding_errors_size);
  return begins_with(kMagicVersion2) ? offsetof(Header, integrator_state_size) : 0;
}

// Splits `body`, the number of bytes after the header. The error says why the numbers cannot be right.
Result<PartSizes> part_sizes(const std::filesystem::path& path, const Header& header, uint64_t body) {
  if (header.width < 1 || header.height < 1 || header.width > 1 << 16 || header.height > 1 << 16 ||
      header.state_size > body || header.integrator_state_size > body || header.rounding_errors_size > body ||
      header.tails_size > body || header.variance_blocks > body / film::TileVariance::kBytesOfBlock)
    return damaged(path, "the sizes in its header are impossible");
  PartSizes sizes{};
  sizes.state = header.state_size;
  sizes.pixels = static_cast<uint64_t>(header.width) * static_cast<uint64_t>(header.height) * sizeof(film::Film::Pixel);
  sizes.variance = header.variance_blocks * film::TileVariance::kBytesOfBlock;
  sizes.integrator_state = header.integrator_state_size;
  sizes.rounding_errors = header.rounding_errors_size;
  sizes.tails = header.tails_size;
  const uint64_t known =
      sizes.state + sizes.pixels + sizes.variance + sizes.integrator_state + sizes.rounding_errors + sizes.tails;
  if (body < known) return damaged(path, "it is truncated");
  sizes.invalid_samples = body - known;
  if (sizes.invalid_samples % sizeof(film::InvalidSample) != 0 ||
      sizes.invalid_samples > film::kListedInvalidSamples * sizeof(film::InvalidSample))
    return damaged(path, "it is truncated");
  return sizes;
}

}  // namespace

std::string checkpoint_of_image(const std::string& image) { return image + ".checkpoint"; }

Result<void> write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  const film::InvalidSamples invalid = checkpoint.film.invalid_samples();
  const auto& variance = checkpoint.film.tile_variance();
  const std::vector<std::byte> rounding_errors = checkpoint.film.rounding_errors().bytes();
  const std::vector<std::byte> tails =
      checkpoint.tails.empty() ? std::vector<std::byte>() : film::bytes_of(checkpoint.tails);
  const std::span<const std::byte> parts[] = {std::as_bytes(std::span(checkpoint.state)),
                                              std::as_bytes(checkpoint.film.pixels()),
                                              variance ? variance->bytes() : std::span<const std::byte>(),
                                              std::span(checkpoint.integrator_state),
                                              std::span(rounding_errors),
                                              std::span(tails),
                                              std::as_bytes(std::span(invalid.first))};
  std::vector<char> bytes(sizeof(Header));
  for (const auto& part : parts) append(bytes, part);
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.state_size = checkpoint.state.size();
  header.width = checkpoint.film.width();
  header.height = checkpoint.film.height();
  header.nan = invalid.nan;
  header.infinite = invalid.infinite;
  header.negative = invalid.negative;
  header.seconds = checkpoint.seconds;
  header.variance_blocks = variance ? variance->blocks() : 0;
  header.integrator_state_size = checkpoint.integrator_state.size();
  header.rounding_errors_size = rounding_errors.size();
  header.tails_size = tails.size();
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
  const size_t header_size = header_size_of(bytes.data());
  if (header_size == 0) return damaged(path, "it is not a checkpoint");
  std::memcpy(&header, bytes.data(), header_size);
  const uint64_t body = bytes.size() - header_size;
  const auto sizes = part_sizes(path, header, body);
  if (!sizes) return sizes.error();
  const char* data = reinterpret_cast<const char*>(bytes.data()) + header_size;
  if (hash_bytes(data, body) != header.hash) return damaged(path, "it is damaged");

  const auto read_part = [&](void* to, uint64_t size) {
    if (size > 0) std::memcpy(to, data, size);
    data += size;
  };
  Checkpoint checkpoint;
  checkpoint.seconds = header.seconds;
  checkpoint.state.resize(sizes->state);
  read_part(checkpoint.state.data(), sizes->state);
  checkpoint.film = film::Film(header.width, header.height);
  read_part(checkpoint.film.pixels().data(), sizes->pixels);
  if (sizes->variance > 0) {
    checkpoint.film.begin_tile_variance(header.variance_blocks);
    read_part(checkpoint.film.tile_variance()->bytes().data(), sizes->variance);
  }
  checkpoint.integrator_state.resize(sizes->integrator_state);
  read_part(checkpoint.integrator_state.data(), sizes->integrator_state);
  std::vector<std::byte> rounding_errors(sizes->rounding_errors);
  read_part(rounding_errors.data(), sizes->rounding_errors);
  if (!checkpoint.film.rounding_errors().restore(rounding_errors))
    return damaged(path, "its rounding errors do not fit the image");
  std::vector<std::byte> tails(sizes->tails);
  read_part(tails.data(), sizes->tails);
  if (!tails.empty()) {
    auto states = film::tail_states_from(tails);
    if (!states || states->size() != TailStatistics::tile_count(header.width, header.height))
      return damaged(path, "its statistics of tails do not fit the image");
    checkpoint.tails = std::move(*states);
  }
  film::InvalidSamples invalid{header.nan, header.infinite, header.negative, {}};
  invalid.first.resize(sizes->invalid_samples / sizeof(film::InvalidSample));
  read_part(invalid.first.data(), sizes->invalid_samples);
  checkpoint.film.set_invalid_samples(invalid);
  return checkpoint;
}

}  // namespace etendue::render
