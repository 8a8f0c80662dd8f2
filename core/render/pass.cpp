#include "render/pass.h"

#include <numeric>

namespace etendue::render {
namespace {

constexpr int kTile = 16;

int tiles_across(int pixels) { return (pixels + kTile - 1) / kTile; }

}  // namespace

PassRunner::PassRunner(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, int width,
                       int height)
    : scene_(std::move(scene)),
      model_(transport::model_for(*scene_, document.forced_flags)),
      sampler_(make_sampler(document.method.sampler, document.method.settings_of(document.method.sampler))),
      integrator_(integrator::make_integrator(document.method.integrator,
                                              document.method.settings_of(document.method.integrator))),
      camera_(document.camera, width, height),
      filter_(document.filter),
      seed_(document.seed),
      width_(width),
      height_(height) {}

bool PassRunner::run(Workers& workers, film::Film& film, uint32_t target, const std::function<bool()>& keep_going,
                     Counters& counters) {
  const uint32_t sample = target - 1;
  const uint32_t table = sample / film::kReplicates / kTableSamples;
  if (table + 1 != prepared_) {
    sampler_->prepare(table * kTableSamples, kTableSamples);
    prepared_ = table + 1;
  }
  if (running_ != target) {
    running_ = target;
    open_tiles_.resize(static_cast<size_t>(tiles_across(width_) * tiles_across(height_)));
    std::iota(open_tiles_.begin(), open_tiles_.end(), 0);
  }
  constexpr int kClosed = -1;
  const auto task = [&](int i) {
    int& entry = open_tiles_[static_cast<size_t>(i)];
    if (tile(film, entry, sample, keep_going, counters)) entry = kClosed;
  };
  workers.run(0, static_cast<int>(open_tiles_.size()), task, keep_going);
  std::erase(open_tiles_, kClosed);
  if (!open_tiles_.empty()) return false;
  running_ = 0;
  return true;
}

bool PassRunner::tile(film::Film& film, int index, uint32_t sample, const std::function<bool()>& keep_going,
                      Counters& counters) const {
  const integrator::Pass pass{scene_.get(), &model_, sampler_.get(), &camera_, &filter_, seed_};
  const int across = tiles_across(width_);
  const int x0 = index % across * kTile, y0 = index / across * kTile;
  const int x1 = std::min(x0 + kTile, width_), y1 = std::min(y0 + kTile, height_);
  std::array<Rgb, kTile> radiance;
  uint64_t rays = 0, paths = 0;
  int y = y0;
  for (; y < y1; ++y) {
    if (!keep_going()) break;
    for (int x = x0; x < x1;) {
      if (film.samples(x, y) > sample) {
        ++x;
        continue;
      }
      int end = x + 1;
      while (end < x1 && film.samples(end, y) <= sample) ++end;
      const integrator::PixelRun run{x, y, end - x, sample};
      rays += integrator_->sample(pass, run, radiance);
      paths += static_cast<uint64_t>(run.count);
      for (int i = 0; i < run.count; ++i)
        film.add(x + i, y, sample % film::kReplicates, radiance[static_cast<size_t>(i)]);
      x = end;
    }
  }
  counters.rays.fetch_add(rays, std::memory_order_relaxed);
  counters.paths.fetch_add(paths, std::memory_order_relaxed);
  return y == y1;
}

}  // namespace etendue::render
