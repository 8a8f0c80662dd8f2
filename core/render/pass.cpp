#include "render/pass.h"

#include <bit>
#include <cmath>
#include <numeric>

namespace etendue::render {
namespace {

// How many pieces of this size cover so many pixels.
int pieces(int pixels, int size) { return (pixels + size - 1) / size; }

void add(const integrator::PixelBlock& block, std::span<const Rgb> radiance, film::Film& film) {
  const Rgb* next = radiance.data();
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) film.add(x, y, block.sample % film::kReplicates, *next++);
}

void add(const integrator::PixelBlock& block, std::span<const Rgb> radiance, film::Cascades& cascades) {
  const Rgb* next = radiance.data();
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x, ++next)
      if (film::is_radiance(*next)) cascades.add(x, y, *next);
}

}  // namespace

PassRunner::PassRunner(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, int width,
                       int height)
    : scene_(std::move(scene)),
      model_(transport::model_for(*scene_, document.forced_flags, document.method.paths)),
      sampler_(make_sampler(document.method.sampler, document.method.settings_of(document.method.sampler))),
      integrator_(integrator::make_integrator(document.method.integrator,
                                              document.method.settings_of(document.method.integrator))),
      camera_(document.camera, width, height, scene_->camera_motion()),
      filter_(document.filter),
      seed_(document.seed),
      adaptive_(document.method.adaptive),
      width_(width),
      height_(height) {}

void PassRunner::begin(film::Film& film) {
  const auto tiles = static_cast<size_t>(pieces(width_, PixelBlock::kWidth) * pieces(height_, PixelBlock::kHeight));
  tiles_ = tiles;
  if (adaptive_ != Adaptive::off) {
    std::vector<int> pixels(tiles);
    for (size_t i = 0; i < tiles; ++i) pixels[i] = block_at(i).width * block_at(i).height;
    allocation_.emplace(adaptive_, std::move(pixels));
    if (!film.spread() || film.spread()->blocks() != tiles) film.begin_spread(tiles);
  }
  samples_ = average(film);
}

// Of the samples of one half, by number: what the running step wants.
Allocation::Piece PassRunner::piece() const {
  if (allocation_) return allocation_->piece();
  return {samples_ / film::kReplicates, samples_ / film::kReplicates + 1};
}

void PassRunner::prepare(uint32_t first_of_half) {
  const uint32_t table = first_of_half / kTableSamples;
  if (table + 1 == prepared_) return;
  sampler_->prepare(table * kTableSamples, kTableSamples);
  prepared_ = table + 1;
}

bool PassRunner::advance(Workers& workers, const Sinks& sinks, const std::function<bool()>& keep_going,
                         Counters& counters, const std::function<bool()>& wanted) {
  prepare(piece().first);
  if (open_tiles_.empty()) {
    open_tiles_.resize(tiles_);
    std::iota(open_tiles_.begin(), open_tiles_.end(), size_t{0});
  }
  constexpr size_t kClosed = SIZE_MAX;
  const Task task{sinks, wanted, counters};
  const auto visit_one = [&](int i) {
    size_t& entry = open_tiles_[static_cast<size_t>(i)];
    if (visit(task, entry)) entry = kClosed;
  };
  workers.run(0, static_cast<int>(open_tiles_.size()), visit_one, keep_going);
  std::erase(open_tiles_, kClosed);
  if (!open_tiles_.empty()) return false;
  finish_step(sinks.film);
  return true;
}

void PassRunner::finish_step(const film::Film& film) {
  if (!allocation_) {
    ++samples_;
  } else {
    allocation_->advance(*film.spread());
    samples_ = average(film);
  }
}

// Of the samples of a pixel; tiles are drawn whole, so that one pixel speaks for all.
uint32_t PassRunner::average(const film::Film& film) const {
  uint64_t samples = 0, least = UINT64_MAX;
  for (size_t i = 0; i < tiles_; ++i) {
    const PixelBlock block = block_at(i);
    const uint64_t n = film.samples(block.x, block.y);
    samples += n * static_cast<uint64_t>(block.width * block.height);
    least = std::min(least, n);
  }
  const auto pixels = static_cast<uint64_t>(width_) * static_cast<uint64_t>(height_);
  return static_cast<uint32_t>(allocation_ ? samples / pixels : least);
}

integrator::PixelBlock PassRunner::block_at(size_t tile) const {
  const int across = pieces(width_, PixelBlock::kWidth), index = static_cast<int>(tile);
  const int x = index % across * PixelBlock::kWidth, y = index / across * PixelBlock::kHeight;
  return {x, y, std::min(PixelBlock::kWidth, width_ - x), std::min(PixelBlock::kHeight, height_ - y), 0};
}

bool PassRunner::visit(const Task& task, size_t tile) const {
  const film::Film& film = task.sinks.film;
  PixelBlock block = block_at(tile);
  if (!allocation_) {
    block.sample = samples_;
    return film.samples(block.x, block.y) > block.sample || sample(task, tile, block);
  }
  for (uint32_t half = 0; half < film::kReplicates; ++half) {
    const uint32_t end = std::min(piece().end, allocation_->target(tile, half));
    for (uint32_t n = film.samples_of_half(block.x, block.y, half); n < end; ++n) {
      block.sample = n * film::kReplicates + half;
      if (!sample(task, tile, block)) return false;
    }
  }
  return true;
}

// One sample of each pixel of a tile; false if it was given up.
bool PassRunner::sample(const Task& task, size_t tile, const PixelBlock& block) const {
  const integrator::Pass pass{scene_.get(), &model_, sampler_.get(), &camera_, &filter_, seed_, &task.wanted};
  std::array<Rgb, PixelBlock::kMostPixels> radiance;
  const std::optional<uint64_t> rays = integrator_->sample(pass, block, radiance);
  if (!rays) return false;
  if (task.sinks.tails)
    task.sinks.tails->add(block, radiance, task.sinks.film);
  else
    add(block, radiance, task.sinks.film);
  if (task.sinks.cascades) add(block, radiance, *task.sinks.cascades);
  if (allocation_) note_spread(task.sinks.film, tile, block, radiance);
  task.counters.rays.fetch_add(*rays, std::memory_order_relaxed);
  task.counters.paths.fetch_add(static_cast<uint64_t>(block.width * block.height), std::memory_order_relaxed);
  return true;
}

// Sums of squares with every sample; variances at powers of two.
void PassRunner::note_spread(film::Film& film, size_t tile, const PixelBlock& block, std::span<const Rgb> radiance) {
  const uint32_t half = block.sample % film::kReplicates, count = block.sample / film::kReplicates + 1;
  double squares = 0;
  const auto pixels = static_cast<size_t>(block.width * block.height);
  for (const Rgb& r : radiance.first(pixels))
    if (const double y = luminance(r); std::isfinite(y)) squares += y * y;
  film::Spread& spread = *film.spread();
  spread.add(tile, half, squares);
  if (!film::Spread::is_kept(count)) return;
  double means = 0, squared_means = 0;
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) {
      const double mean = luminance(film.mean_of_half(x, y, half));
      means += mean, squared_means += mean * mean;
    }
  const auto n = static_cast<double>(pixels);
  const double variance = (spread.squares(tile, half) - count * squared_means) / (count - 1.0);
  spread.keep(tile, half, std::countr_zero(count),
              {static_cast<float>(variance / n), static_cast<float>(means / n), true});
}

}  // namespace etendue::render
