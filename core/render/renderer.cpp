#include "render/renderer.h"

#include <array>
#include <numeric>

namespace etendue::render {
namespace {

// Number of tiles of this size that cover a row or column of pixels.
int tiles_across(int pixels, int size) { return (pixels + size - 1) / size; }

// Discards the splats of a cancelled task. The task runs again from its beginning.
bool cancel(film::Splats* splats) {
  if (splats) splats->clear();
  return false;
}

bool has_same_pixels(const integrator::PixelBlock& a, const integrator::PixelBlock& b) {
  return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

// The values of the pixels of `part`, which lies in `block`.
void copy_pixels(const integrator::PixelBlock& block, std::span<const Rgb> radiance, const integrator::PixelBlock& part,
                 std::span<Rgb> target) {
  Rgb* next = target.data();
  for (int y = part.y; y < part.y + part.height; ++y) {
    const Rgb* row = &radiance[static_cast<size_t>((y - block.y) * block.width + part.x - block.x)];
    next = std::copy_n(row, part.width, next);
  }
}

}  // namespace

Renderer::Renderer(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, int width, int height,
                   const Renderer* previous, integrator::PathLayerRecording* layers)
    : prepared_(document, std::move(scene), width, height, layers),
      width_(width),
      height_(height),
      first_sample_(document.part.first_sample),
      part_(document.part.region.value_or(PixelRect{0, 0, width, height})),
      region_(part_),
      adaptive_(prepared_.accumulation() == integrator::Accumulation::per_pixel ? document.method.adaptive
                                                                                : Adaptive::off),
      state_(prepared_.begin(prepared_.context(), previous ? previous->state_.get() : nullptr)),
      splat_image_(width, height) {}

size_t Renderer::memory() const { return state_->memory() + splat_image_.memory(); }

void Renderer::lay_out_tiles() {
  columns_ = tiles_across(region_.right(), PixelBlock::kWidth) - region_.x / PixelBlock::kWidth;
  const int rows = tiles_across(region_.bottom(), PixelBlock::kHeight) - region_.y / PixelBlock::kHeight;
  tiles_ = static_cast<size_t>(columns_ * rows);
}

void Renderer::begin(film::Film& film, std::span<const std::byte> integrator_state) {
  lay_out_tiles();
  film.set_first_sample(first_sample_);
  film.allow_negative_samples(prepared_.has_negative_samples());
  if (adaptive_ != Adaptive::off) {
    std::vector<int> pixels(tiles_);
    for (size_t i = 0; i < tiles_; ++i) pixels[i] = block_at(i).width * block_at(i).height;
    allocation_.emplace(adaptive_, std::move(pixels));
    if (!film.tile_variance() || film.tile_variance()->blocks() != tiles_) film.begin_tile_variance(tiles_);
  }
  samples_ = samples_of(film);
  if (!integrator_state.empty()) state_->restore(integrator_state);
}

// A step that only samples blocks may be abandoned: blocks that have its sample are skipped when it is taken again.
bool Renderer::restrict_to(const std::optional<PixelRect>& region, const film::Film& film) {
  const bool only_blocks = stages_.size() == 1 && stages_.front().kind == Stage::Kind::blocks;
  if (is_in_step() && !only_blocks) return false;
  stages_.clear();
  open_tasks_.clear();
  region_ = region.value_or(part_);
  lay_out_tiles();
  samples_ = samples_of(film);
  return true;
}

// The samples that the current step takes, counted within each half-buffer.
SampleRange Renderer::range() const {
  if (allocation_) return allocation_->range();
  return {sample() / film::kHalfBuffers, sample() / film::kHalfBuffers + 1};
}

// Tiles are sampled as a whole, so one pixel stands for all pixels of its tile.
uint32_t Renderer::samples_of(const film::Film& film) const {
  uint64_t sum = 0, least = UINT64_MAX;
  for (size_t i = 0; i < tiles_; ++i) {
    const PixelBlock block = visible(block_at(i));
    const uint64_t n = film.samples(block.x, block.y);
    sum += n * static_cast<uint64_t>(block.width * block.height);
    least = std::min(least, n);
  }
  const auto pixels = static_cast<uint64_t>(region_.width) * static_cast<uint64_t>(region_.height);
  return static_cast<uint32_t>(allocation_ ? sum / pixels : least);
}

integrator::PixelBlock Renderer::block_at(size_t tile) const {
  const int index = static_cast<int>(tile);
  return integrator::block_containing(region_.x + index % columns_ * PixelBlock::kWidth,
                                      region_.y + index / columns_ * PixelBlock::kHeight, width_, height_, 0);
}

integrator::PixelBlock Renderer::visible(const PixelBlock& block) const {
  const int left = std::max(block.x, region_.x), right = std::min(block.x + block.width, region_.right());
  const int top = std::max(block.y, region_.y), bottom = std::min(block.y + block.height, region_.bottom());
  return {.x = left, .y = top, .width = right - left, .height = bottom - top, .sample = block.sample};
}

bool Renderer::advance(ThreadPool& workers, const FilmTargets& targets, const std::function<bool()>& keep_going,
                       Counters& counters, const std::function<bool()>& still_needed) {
  if (stages_.empty()) plan_step();
  const StepContext step{targets, still_needed, counters};
  while (stage_ < stages_.size()) {
    if (!run_stage(workers, step, keep_going)) return false;
    ++stage_;
    batch_end_ = 0;
  }
  stages_.clear();
  finish_step(targets.film);
  return true;
}

void Renderer::plan_step() {
  prepared_.prepare_sampler(range().first);
  if (splats()) splat_image_.begin_sample();
  const std::vector<integrator::Phase> phases = state_->phases(sample());
  for (size_t i = 0; i < phases.size(); ++i)
    stages_.push_back({Stage::Kind::phase, i, static_cast<size_t>(phases[i].tasks), phases[i].name});
  if (samples_blocks()) stages_.push_back({Stage::Kind::blocks, 0, tiles_});
  if (splats()) stages_.push_back({Stage::Kind::deposit, 0, tiles_});
  stage_ = 0;
  batch_end_ = 0;
}

bool Renderer::run_stage(ThreadPool& workers, const StepContext& step, const std::function<bool()>& keep_going) {
  Stage& stage = stages_[stage_];
  // The tasks of a phase may depend on the phases before it.
  if (stage.kind == Stage::Kind::phase && batch_end_ == 0)
    stage.tasks = static_cast<size_t>(state_->task_count(sample(), stage.phase, static_cast<int>(stage.tasks)));
  while (!open_tasks_.empty() || batch_end_ < stage.tasks) {
    if (open_tasks_.empty()) begin_batch();
    constexpr size_t kDone = SIZE_MAX;
    const auto run_one = [&](int i) {
      size_t& entry = open_tasks_[static_cast<size_t>(i)];
      if (run_task(step, entry)) entry = kDone;
    };
    workers.run(0, static_cast<int>(open_tasks_.size()), run_one, keep_going);
    std::erase(open_tasks_, kDone);
    if (!open_tasks_.empty()) return false;
    if (writes_splats(stage)) splat_image_.merge_batch(workers);
  }
  if (stage.kind == Stage::Kind::phase) state_->finish(sample(), stage.phase);
  return true;
}

// Stages without splats form one batch.
void Renderer::begin_batch() {
  const Stage& stage = stages_[stage_];
  batch_begin_ = batch_end_;
  batch_end_ = stage.tasks;
  if (writes_splats(stage)) {
    batch_end_ = std::min(stage.tasks, batch_begin_ + SplatImage::kBatchTasks);
    splat_image_.begin_batch();
  }
  open_tasks_.resize(batch_end_ - batch_begin_);
  std::iota(open_tasks_.begin(), open_tasks_.end(), batch_begin_);
}

void Renderer::finish_step(const film::Film& film) {
  if (!allocation_) {
    ++samples_;
  } else {
    allocation_->advance(*film.tile_variance());
    samples_ = samples_of(film);
  }
}

Renderer::Progress Renderer::progress() const {
  if (stage_ >= stages_.size() || stages_[stage_].kind != Stage::Kind::phase) return {};
  const Stage& stage = stages_[stage_];
  const size_t done = batch_end_ - open_tasks_.size();
  return {stage.name, stage.tasks > 0 ? static_cast<double>(done) / static_cast<double>(stage.tasks) : 1};
}

bool Renderer::run_task(const StepContext& step, size_t index) {
  switch (stages_[stage_].kind) {
    case Stage::Kind::phase:
      return run_phase(step, index);
    case Stage::Kind::blocks:
      return sample_tile(step, index);
    case Stage::Kind::deposit:
      return deposit_tile(step, index);
  }
  return true;
}

film::Splats* Renderer::splat_list(size_t index) {
  return splats() ? &splat_image_.list(index - batch_begin_) : nullptr;
}

bool Renderer::run_phase(const StepContext& step, size_t index) {
  film::Splats* splats = splat_list(index);
  const auto rays = state_->run(sample(), stages_[stage_].phase, static_cast<int>(index), {&step.still_needed, splats});
  if (!rays) return cancel(splats);
  step.counters.rays.fetch_add(*rays, std::memory_order_relaxed);
  return true;
}

// Takes the samples of the current range in a tile.
bool Renderer::sample_tile(const StepContext& step, size_t tile) {
  const film::Film& film = step.targets.film;
  PixelBlock block = block_at(tile);
  if (!allocation_) {
    block.sample = sample();
    const PixelBlock shown = visible(block);
    // A resumed film may hold this sample already. Splats of the sample still concern all pixels.
    return (!splats() && film.samples(shown.x, shown.y) > samples_ + received_) || sample_block(step, tile, block);
  }
  for (uint32_t half = 0; half < film::kHalfBuffers; ++half) {
    const uint32_t end = std::min(range().end, allocation_->target(tile, half));
    for (uint32_t n = film.half_buffer_samples(block.x, block.y, half); n < end; ++n) {
      block.sample = n * film::kHalfBuffers + half;
      if (!sample_block(step, tile, block)) return false;
    }
  }
  return true;
}

// Takes one sample of each pixel of a block.
bool Renderer::sample_block(const StepContext& step, size_t tile, const PixelBlock& block) {
  std::array<Rgb, PixelBlock::kMostPixels> radiance;
  film::Splats* splats = splat_list(tile);
  const std::optional<uint64_t> rays = state_->sample(block, radiance, {&step.still_needed, splats});
  if (!rays) return cancel(splats);
  if (splats)
    splat_image_.add(block, radiance);
  else
    record(step, tile, block, radiance);
  step.counters.rays.fetch_add(*rays, std::memory_order_relaxed);
  return true;
}

// Transfers the current sample of a tile, with all its splats, to the film.
bool Renderer::deposit_tile(const StepContext& step, size_t tile) {
  PixelBlock block = block_at(tile);
  block.sample = sample();
  if (step.targets.film.samples(block.x, block.y) > samples_ + received_) return true;
  std::array<Rgb, PixelBlock::kMostPixels> radiance;
  splat_image_.read(block, radiance);
  record(step, tile, block, radiance);
  return true;
}

void Renderer::record(const StepContext& step, size_t tile, const PixelBlock& block,
                      std::span<const Rgb> radiance) const {
  const PixelBlock shown = visible(block);
  if (has_same_pixels(shown, block)) {
    record_samples(step.targets, block, radiance);
  } else {
    std::array<Rgb, PixelBlock::kMostPixels> part;
    copy_pixels(block, radiance, shown, part);
    record_samples(step.targets, shown, part);
  }
  if (allocation_) record_tile_variance(step.targets.film, tile, block, radiance);
  step.counters.paths.fetch_add(static_cast<uint64_t>(shown.width * shown.height), std::memory_order_relaxed);
}

}  // namespace etendue::render
