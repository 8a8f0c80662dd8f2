#include "film/film_sum.h"

namespace etendue::film {
namespace {

// Adds what rounding has removed from the sums of a pixel.
void add_rounding_errors(Film& to, const Film& from, int x, int y, uint32_t half) {
  from.rounding_errors().for_each_level(
      x, y, half, [&](const RoundingErrors::Channels& errors) { to.add_sum(x, y, half, errors, 0); });
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
