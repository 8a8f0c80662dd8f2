#include "render/renderer.h"

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
    for (int x = block.x; x < block.x + block.width; ++x) film.add(x, y, block.sample % film::kHalfBuffers, *next++);
}

void add(const integrator::PixelBlock& block, std::span<const Rgb> radiance, film::FireflyReweighting& reweighting) {
  const Rgb* next = radiance.data();
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x, ++next)
      if (film::is_radiance(*next)) reweighting.add(x, y, *next);
}

}  // namespace

Renderer::Renderer(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, int width, int height,
                   const Renderer* previous)
    : scene_(std::move(scene)),
      model_(transport::model_for(*scene_, document.forced_flags, document.method.paths)),
      sampler_(make_sampler(document.method.sampler, document.method.settings_of(document.method.sampler))),
      integrator_(integrator::make_integrator(document.method.integrator,
                                              document.method.settings_of(document.method.integrator))),
      camera_(document.camera, width, height, scene_->camera_motion()),
      filter_(document.filter),
      seed_(document.seed),
      width_(width),
      height_(height),
      sampling_(integrator::find_integrator(document.method.integrator)->accumulation),
      adaptive_(sampling_ == integrator::Accumulation::per_pixel ? document.method.adaptive : Adaptive::off),
      work_(integrator_->begin({scene_.get(), &model_, sampler_.get(), &camera_, &filter_, seed_, width, height},
                               previous ? previous->work_.get() : nullptr)) {}

size_t Renderer::memory() const {
  size_t bytes = work_->memory() + picture_.capacity() * sizeof(Rgb);
  for (const film::Splats& list : splatted_) bytes += list.capacity() * sizeof(film::Splat);
  return bytes;
}

void Renderer::begin(film::Film& film, std::span<const std::byte> work) {
  const auto tiles = static_cast<size_t>(pieces(width_, PixelBlock::kWidth) * pieces(height_, PixelBlock::kHeight));
  tiles_ = tiles;
  if (adaptive_ != Adaptive::off) {
    std::vector<int> pixels(tiles);
    for (size_t i = 0; i < tiles; ++i) pixels[i] = block_at(i).width * block_at(i).height;
    allocation_.emplace(adaptive_, std::move(pixels));
    if (!film.tile_variance() || film.tile_variance()->blocks() != tiles) film.begin_tile_variance(tiles);
  }
  samples_ = average(film);
  // Work that refuses a state goes on without.
  if (!work.empty()) work_->restore(work);
}

// Of the samples of one half, by number: what the running step wants.
SampleAllocation::Piece Renderer::piece() const {
  if (allocation_) return allocation_->piece();
  return {samples_ / film::kHalfBuffers, samples_ / film::kHalfBuffers + 1};
}

void Renderer::prepare(uint32_t first_of_half) {
  const uint32_t table = first_of_half / kTableSamples;
  if (table + 1 == prepared_) return;
  sampler_->prepare(table * kTableSamples, kTableSamples);
  prepared_ = table + 1;
}

bool Renderer::advance(ThreadPool& workers, const Sinks& sinks, const std::function<bool()>& keep_going,
                       Counters& counters, const std::function<bool()>& still_needed) {
  if (stages_.empty()) plan();
  const Task task{sinks, still_needed, counters};
  for (; stage_ < stages_.size(); ++stage_, group_end_ = 0)
    if (!run_stage(workers, task, keep_going)) return false;
  stages_.clear();
  finish_step(sinks.film);
  return true;
}

// The stages of the next step.
void Renderer::plan() {
  prepare(piece().first);
  if (splats()) picture_.assign(static_cast<size_t>(width_) * static_cast<size_t>(height_), Rgb(0));
  const std::vector<integrator::Phase> phases = work_->phases(samples_);
  for (size_t i = 0; i < phases.size(); ++i)
    stages_.push_back({Stage::Kind::phase, i, static_cast<size_t>(phases[i].tasks), phases[i].name});
  if (has_blocks()) stages_.push_back({Stage::Kind::blocks, 0, tiles_});
  if (splats()) stages_.push_back({Stage::Kind::deposit, 0, tiles_});
  stage_ = group_end_ = 0;
}

bool Renderer::run_stage(ThreadPool& workers, const Task& task, const std::function<bool()>& keep_going) {
  const Stage& stage = stages_[stage_];
  while (!open_.empty() || group_end_ < stage.tasks) {
    if (open_.empty()) open_group();
    constexpr size_t kClosed = SIZE_MAX;
    const auto run_one = [&](int i) {
      size_t& entry = open_[static_cast<size_t>(i)];
      if (run(task, entry)) entry = kClosed;
    };
    workers.run(0, static_cast<int>(open_.size()), run_one, keep_going);
    std::erase(open_, kClosed);
    if (!open_.empty()) return false;
    add_splats(workers);
  }
  if (stage.kind == Stage::Kind::phase) work_->finish(samples_, stage.phase);
  return true;
}

// The next tasks that are handed out together: all of them where nothing is splatted.
void Renderer::open_group() {
  constexpr size_t kGroup = 128;
  const Stage& stage = stages_[stage_];
  const bool lists = splats() && stage.kind != Stage::Kind::deposit;
  group_ = group_end_;
  group_end_ = lists ? std::min(stage.tasks, group_ + kGroup) : stage.tasks;
  open_.resize(group_end_ - group_);
  std::iota(open_.begin(), open_.end(), group_);
  if (!lists) return;
  splatted_.resize(kGroup);
  for (film::Splats& list : splatted_) list.clear();
}

// What a group found is added up in the order of its tasks.
void Renderer::add_splats(ThreadPool& workers) {
  if (!splats() || stages_[stage_].kind == Stage::Kind::deposit) return;
  workers.for_bands(height_, [&](int first, int end) { film::add_rows(splatted_, width_, first, end, picture_); });
  for (film::Splats& list : splatted_) list.clear();
}

Renderer::Progress Renderer::progress() const {
  if (stage_ >= stages_.size() || stages_[stage_].kind != Stage::Kind::phase) return {};
  const Stage& stage = stages_[stage_];
  const size_t done = group_end_ - open_.size();
  return {stage.name, stage.tasks > 0 ? static_cast<double>(done) / static_cast<double>(stage.tasks) : 1};
}

bool Renderer::run(const Task& task, size_t index) {
  switch (stages_[stage_].kind) {
    case Stage::Kind::phase:
      return run_phase(task, index);
    case Stage::Kind::blocks:
      return visit(task, index);
    case Stage::Kind::deposit:
      return deposit(task, index);
  }
  return true;
}

bool Renderer::run_phase(const Task& task, size_t index) {
  film::Splats* splats = splat_list(index);
  const auto rays = work_->run(samples_, stages_[stage_].phase, static_cast<int>(index), {&task.still_needed, splats});
  if (!rays) return give_up(splats);
  task.counters.rays.fetch_add(*rays, std::memory_order_relaxed);
  return true;
}

// Of a task of the group that is being handed out.
film::Splats* Renderer::splat_list(size_t index) { return splats() ? &splatted_[index - group_] : nullptr; }

// What a task found before it was given up is found again.
bool Renderer::give_up(film::Splats* splats) {
  if (splats) splats->clear();
  return false;
}

void Renderer::finish_step(const film::Film& film) {
  if (!allocation_) {
    ++samples_;
  } else {
    allocation_->advance(*film.tile_variance());
    samples_ = average(film);
  }
}

// Of the samples of a pixel; tiles are drawn whole, so that one pixel speaks for all.
uint32_t Renderer::average(const film::Film& film) const {
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

integrator::PixelBlock Renderer::block_at(size_t tile) const {
  const int across = pieces(width_, PixelBlock::kWidth), index = static_cast<int>(tile);
  const int x = index % across * PixelBlock::kWidth, y = index / across * PixelBlock::kHeight;
  return {x, y, std::min(PixelBlock::kWidth, width_ - x), std::min(PixelBlock::kHeight, height_ - y), 0};
}

bool Renderer::visit(const Task& task, size_t tile) {
  const film::Film& film = task.sinks.film;
  PixelBlock block = block_at(tile);
  if (!allocation_) {
    block.sample = samples_;
    // A film that goes on may have this sample already; splats belong to all of them.
    return (!splats() && film.samples(block.x, block.y) > block.sample) || sample(task, tile, block);
  }
  for (uint32_t half = 0; half < film::kHalfBuffers; ++half) {
    const uint32_t end = std::min(piece().end, allocation_->target(tile, half));
    for (uint32_t n = film.half_buffer_samples(block.x, block.y, half); n < end; ++n) {
      block.sample = n * film::kHalfBuffers + half;
      if (!sample(task, tile, block)) return false;
    }
  }
  return true;
}

// One sample of each pixel of a tile.
bool Renderer::sample(const Task& task, size_t tile, const PixelBlock& block) {
  std::array<Rgb, PixelBlock::kMostPixels> radiance;
  film::Splats* splats = splat_list(tile);
  const std::optional<uint64_t> rays = work_->sample(block, radiance, {&task.still_needed, splats});
  if (!rays) return give_up(splats);
  if (splats)
    add_to_picture(block, radiance);
  else
    add(task, tile, block, radiance);
  task.counters.rays.fetch_add(*rays, std::memory_order_relaxed);
  return true;
}

// Blocks that came before may have splatted on these pixels.
void Renderer::add_to_picture(const PixelBlock& block, std::span<const Rgb> radiance) {
  const Rgb* next = radiance.data();
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) pixel(x, y) += *next++;
}

Rgb& Renderer::pixel(int x, int y) {
  return picture_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
}

// This sample of a tile's pixels, all splats included, goes into the film.
bool Renderer::deposit(const Task& task, size_t tile) {
  PixelBlock block = block_at(tile);
  block.sample = samples_;
  if (task.sinks.film.samples(block.x, block.y) > block.sample) return true;
  std::array<Rgb, PixelBlock::kMostPixels> radiance;
  Rgb* next = radiance.data();
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) *next++ = pixel(x, y);
  add(task, tile, block, radiance);
  return true;
}

// To the film, and to what watches it.
void Renderer::add(const Task& task, size_t tile, const PixelBlock& block, std::span<const Rgb> radiance) const {
  if (task.sinks.tails)
    task.sinks.tails->add(block, radiance, task.sinks.film);
  else
    render::add(block, radiance, task.sinks.film);
  if (task.sinks.reweighting) render::add(block, radiance, *task.sinks.reweighting);
  if (allocation_) record_tile_variance(task.sinks.film, tile, block, radiance);
  task.counters.paths.fetch_add(static_cast<uint64_t>(block.width * block.height), std::memory_order_relaxed);
}

// Sums of squares with every sample; variances at powers of two.
void Renderer::record_tile_variance(film::Film& film, size_t tile, const PixelBlock& block,
                                    std::span<const Rgb> radiance) {
  const uint32_t half = block.sample % film::kHalfBuffers, count = block.sample / film::kHalfBuffers + 1;
  double squares = 0;
  const auto pixels = static_cast<size_t>(block.width * block.height);
  for (const Rgb& r : radiance.first(pixels))
    if (const double y = luminance(r); std::isfinite(y)) squares += y * y;
  film::TileVariance& spread = *film.tile_variance();
  spread.add(tile, half, squares);
  if (!film::TileVariance::is_recorded(count)) return;
  double means = 0, squared_means = 0;
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) {
      const double mean = luminance(film.half_buffer_mean(x, y, half));
      means += mean, squared_means += mean * mean;
    }
  const auto n = static_cast<double>(pixels);
  const double variance = (spread.squares(tile, half) - count * squared_means) / (count - 1.0);
  spread.record(tile, half, std::countr_zero(count),
                {static_cast<float>(variance / n), static_cast<float>(means / n), true});
}

}  // namespace etendue::render
