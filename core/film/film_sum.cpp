#include "film/film_sum.h"

namespace etendue::film {
namespace {

// Adds what rounding has removed from the sums of a pixel, level by level.
void add_rounding_errors(Film& to, const Film& from, int x, int y, uint32_t half) {
  std::array<std::vector<double>, 3> levels;
  for (size_t c = 0; c < 3; ++c) levels[c] = from.rounding_errors().errors(x, y, half, c);
  for (size_t level = 0; level < levels[0].size(); ++level)
    to.add_sum(x, y, half, {levels[0][level], levels[1][level], levels[2][level]}, 0);
}

}  // namespace

void add_film(Film& to, const Film& from) {
  add_rows(to, from, 0, from.height());
  add_invalid_samples(to, from);
}

void add_rows(Film& to, const Film& from, int first, int end) {
  const Film::Pixel* pixel = from.pixels().data() + static_cast<ptrdiff_t>(first) * from.width();
  for (int y = first; y < end; ++y)
    for (int x = 0; x < from.width(); ++x, ++pixel) {
      const bool is_exact = !from.rounding_errors().any_at(x, y);
      for (uint32_t half = 0; half < kHalfBuffers; ++half) {
        to.add_sum(x, y, half, pixel->sum[half], pixel->count[half]);
        if (!is_exact) add_rounding_errors(to, from, x, y, half);
      }
    }
}

void add_invalid_samples(Film& to, const Film& from) {
  InvalidSamples invalid = to.invalid_samples();
  merge(invalid, from.invalid_samples());
  to.set_invalid_samples(invalid);
}

}  // namespace etendue::film
