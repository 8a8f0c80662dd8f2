#include "cluster/piece_result.h"

#include <cstring>
#include <utility>

#include "base/hash.h"
#include "base/state_bytes.h"
#include "film/film_sum.h"
#include "render/tail_statistics.h"

namespace etendue::cluster {
namespace {

// Head of the message. Pixels, rounding errors, tails and invalid samples follow.
struct ResultHeader {
  Piece piece;
  uint64_t rays, paths, nan, infinite, negative;
  int32_t width, height;
};

// A checksum of whole words; the last word is filled with zeros.
uint64_t checksum_of(std::span<const std::byte> bytes) {
  uint64_t sum = bytes.size();
  for (size_t i = 0; i < bytes.size(); i += sizeof(uint64_t)) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    sum = mix_bits(sum ^ (word + uint64_t{0x9e3779b97f4a7c15}));
  }
  return sum;
}

bool read_film(StateReader& in, const ResultHeader& header, film::Film& film) {
  std::vector<film::Film::Pixel> pixels;
  std::vector<std::byte> errors;
  film::InvalidSamples invalid{header.nan, header.infinite, header.negative, {}};
  if (!in.list(pixels) || !in.list(errors) || !in.list(invalid.first)) return false;
  film = film::Film(header.width, header.height);
  if (pixels.size() != film.pixels().size()) return false;
  std::ranges::copy(pixels, film.pixels().begin());
  if (!film.rounding_errors().restore(errors)) return false;
  film.set_invalid_samples(invalid);
  return true;
}

}  // namespace

void add_samples(render::PartialSamples& to, const render::PartialSamples& from) {
  film::add_film(to.film, from.film);
  const size_t capacity = render::TailStatistics::capacity(to.film.width(), to.film.height());
  for (size_t i = 0; i < to.tails.size(); ++i) film::merge(to.tails[i], from.tails[i], capacity);
}

std::vector<std::byte> bytes_of(const PieceResult& result) {
  const film::Film& film = result.samples.film;
  const film::InvalidSamples invalid = film.invalid_samples();
  const auto errors = film.rounding_errors().bytes(), tails = film::bytes_of(result.samples.tails);
  StateWriter out;
  out.value(ResultHeader{result.piece, result.rays, result.paths, invalid.nan, invalid.infinite, invalid.negative,
                         film.width(), film.height()});
  out.list(film.pixels());
  out.list(std::span<const std::byte>(errors));
  out.list(std::span<const film::InvalidSample>(invalid.first));
  out.list(std::span<const std::byte>(tails));
  std::vector<std::byte> bytes = out.take();
  const uint64_t checksum = checksum_of(bytes);
  const auto* begin = reinterpret_cast<const std::byte*>(&checksum);
  bytes.insert(bytes.end(), begin, begin + sizeof checksum);
  return bytes;
}

std::optional<PieceResult> piece_result_from(std::span<const std::byte> bytes, int width, int height) {
  uint64_t checksum = 0;
  if (bytes.size() < sizeof checksum) return std::nullopt;
  std::memcpy(&checksum, bytes.data() + bytes.size() - sizeof checksum, sizeof checksum);
  bytes = bytes.first(bytes.size() - sizeof checksum);
  if (checksum_of(bytes) != checksum) return std::nullopt;
  StateReader in(bytes);
  ResultHeader header{};
  if (!in.value(header) || header.width != width || header.height != height) return std::nullopt;
  PieceResult result{.piece = header.piece, .samples = {}, .rays = header.rays, .paths = header.paths};
  std::vector<std::byte> tail_bytes;
  if (!read_film(in, header, result.samples.film) || !in.list(tail_bytes) || !in.at_end()) return std::nullopt;
  auto tails = film::tail_states_from(tail_bytes);
  if (!tails || tails->size() != render::TailStatistics::tile_count(width, height)) return std::nullopt;
  result.samples.tails = std::move(*tails);
  return result;
}

}  // namespace etendue::cluster
