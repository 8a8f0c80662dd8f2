#include "render/film_recording.h"

#include <bit>
#include <cmath>

namespace etendue::render {
namespace {

using integrator::PixelBlock;

void add_to_film(const PixelBlock& block, std::span<const Rgb> radiance, film::Film& film) {
  const Rgb* next = radiance.data();
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) film.add(x, y, block.sample % film::kHalfBuffers, *next++);
}

void add_to_cascades(const PixelBlock& block, std::span<const Rgb> radiance, film::FireflyReweighting& reweighting) {
  const Rgb* next = radiance.data();
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x, ++next)
      if (film::is_radiance(*next)) reweighting.add(x, y, *next);
}

}  // namespace

void record_samples(const FilmTargets& targets, const PixelBlock& block, std::span<const Rgb> radiance) {
  if (targets.tails)
    targets.tails->add(block, radiance, targets.film);
  else
    add_to_film(block, radiance, targets.film);
  if (targets.reweighting) add_to_cascades(block, radiance, *targets.reweighting);
}

// The sum of squared luminances grows with every sample. The variance of a tile is evaluated and stored whenever the
// number of samples is a power of two.
void record_tile_variance(film::Film& film, size_t tile, const PixelBlock& block, std::span<const Rgb> radiance) {
  const uint32_t half = block.sample % film::kHalfBuffers;
  const uint32_t count = block.sample / film::kHalfBuffers + 1;
  double squares = 0;
  const auto pixels = static_cast<size_t>(block.width * block.height);
  for (const Rgb& r : radiance.first(pixels))
    if (film.accepts(r)) squares += sqr(double{luminance(r)});
  film::TileVariance& tile_variance = *film.tile_variance();
  tile_variance.add(tile, half, squares);
  if (!film::TileVariance::is_recorded(count)) return;
  double means = 0, squared_means = 0;
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) {
      const double mean = luminance(film.half_buffer_mean(x, y, half));
      means += mean;
      squared_means += mean * mean;
    }
  const auto n = static_cast<double>(pixels);
  const double variance = (tile_variance.squares(tile, half) - count * squared_means) / (count - 1.0);
  tile_variance.record(tile, half, std::countr_zero(count),
                     {static_cast<float>(variance / n), static_cast<float>(means / n), true});
}

}  // namespace etendue::render
