#include "render/pass.h"

#include <numeric>

namespace etendue::render {
namespace {

using integrator::PixelBlock;

// How many pieces of this size cover so many pixels.
int pieces(int pixels, int size) { return (pixels + size - 1) / size; }

void add(const PixelBlock& block, std::span<const Rgb> radiance, film::Film& film) {
  const Rgb* next = radiance.data();
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) film.add(x, y, block.sample % film::kReplicates, *next++);
}

void add(const PixelBlock& block, std::span<const Rgb> radiance, film::Cascades& cascades) {
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
      camera_(document.camera, width, height),
      filter_(document.filter),
      seed_(document.seed),
      width_(width),
      height_(height) {}

bool PassRunner::run(Workers& workers, const Sinks& sinks, uint32_t target, const std::function<bool()>& keep_going,
                     Counters& counters, const std::function<bool()>& wanted) {
  const uint32_t sample = target - 1;
  const uint32_t table = sample / film::kReplicates / kTableSamples;
  if (table + 1 != prepared_) {
    sampler_->prepare(table * kTableSamples, kTableSamples);
    prepared_ = table + 1;
  }
  if (running_ != target) {
    running_ = target;
    open_tiles_.resize(static_cast<size_t>(pieces(width_, PixelBlock::kWidth) * pieces(height_, PixelBlock::kHeight)));
    std::iota(open_tiles_.begin(), open_tiles_.end(), 0);
  }
  constexpr int kClosed = -1;
  const auto task = [&](int i) {
    int& entry = open_tiles_[static_cast<size_t>(i)];
    if (tile(sinks, entry, sample, wanted, counters)) entry = kClosed;
  };
  workers.run(0, static_cast<int>(open_tiles_.size()), task, keep_going);
  std::erase(open_tiles_, kClosed);
  if (!open_tiles_.empty()) return false;
  running_ = 0;
  return true;
}

bool PassRunner::tile(const Sinks& sinks, int index, uint32_t sample, const std::function<bool()>& wanted,
                      Counters& counters) const {
  const integrator::Pass pass{scene_.get(), &model_, sampler_.get(), &camera_, &filter_, seed_, &wanted};
  const int across = pieces(width_, PixelBlock::kWidth);
  const int x0 = index % across * PixelBlock::kWidth, y0 = index / across * PixelBlock::kHeight;
  const PixelBlock block{x0, y0, std::min(PixelBlock::kWidth, width_ - x0), std::min(PixelBlock::kHeight, height_ - y0),
                         sample};
  // Tiles are drawn whole, so that one pixel speaks for all: which rays share a packet is always the same.
  if (sinks.film.samples(x0, y0) > sample) return true;
  std::array<Rgb, PixelBlock::kMostPixels> radiance;
  const std::optional<uint64_t> rays = integrator_->sample(pass, block, radiance);
  if (!rays) return false;
  if (sinks.tails)
    sinks.tails->add(block, radiance, sinks.film);
  else
    add(block, radiance, sinks.film);
  if (sinks.cascades) add(block, radiance, *sinks.cascades);
  counters.rays.fetch_add(*rays, std::memory_order_relaxed);
  counters.paths.fetch_add(static_cast<uint64_t>(block.width * block.height), std::memory_order_relaxed);
  return true;
}

}  // namespace etendue::render
