// Adding samples to a film and to the statistics that are collected with it.
#pragma once
#include <span>

#include "film/film.h"
#include "film/firefly_reweighting.h"
#include "render/tail_statistics.h"

namespace etendue::render {

// The film that samples are added to, and the statistics that receive the same samples. Null statistics are not
// collected.
struct FilmTargets {
  film::Film& film;
  TailStatistics* tails = nullptr;
  film::FireflyReweighting* reweighting = nullptr;
};

// Adds one sample of each pixel of a block. Blocks without common pixels may be added from different threads.
void record_samples(const FilmTargets& targets, const integrator::PixelBlock& block, std::span<const Rgb> radiance);

// Updates the statistics of adaptive sampling after `record_samples` of the same samples. `tile` is the number of the
// block. The film must collect tile variances.
void record_tile_variance(film::Film& film, size_t tile, const integrator::PixelBlock& block,
                          std::span<const Rgb> radiance);

}  // namespace etendue::render
