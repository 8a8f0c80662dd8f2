// Cost of photon mapping: rays per second of photon tracing relative to `path`, building the photon map, and lookups.
//
// The Cornell box on one thread. The three measurements alternate; the best of each counts.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "integrator/integrator.h"
#include "integrator/photon/photon_emission.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using Clock = std::chrono::steady_clock;
using integrator::PhotonEmission;
using integrator::PixelBlock;

double seconds(const auto& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Rig {
 public:
  static constexpr int kSize = 256;

  Rig()
      : document_(test::cornell(kSize)),
        scene_(scene::compile(document_.scene, document_.camera, nullptr)),
        model_(transport::model_for(*scene_)),
        sampler_(make_sampler("sobol")),
        camera_(document_.camera, kSize, kSize),
        path_(integrator::make_integrator("path")),
        work_(path_->begin(context(), nullptr)) {
    sampler_->prepare(0, 64);
  }

  // Rays per second for one sample of all pixels.
  double paths(uint32_t sample) const {
    std::vector<Rgb> radiance(PixelBlock::kMostPixels);
    uint64_t rays = 0;
    const double took = seconds([&] {
      for (int y = 0; y < kSize; y += PixelBlock::kHeight)
        for (int x = 0; x < kSize; x += PixelBlock::kWidth)
          rays += *work_->sample({x, y, PixelBlock::kWidth, PixelBlock::kHeight, sample}, radiance, {});
    });
    return static_cast<double>(rays) / took;
  }

  struct Photons {
    double rays_per_second, ordering, microseconds_a_lookup;
    size_t stored;
  };
  Photons photons(int emitted, uint32_t sample) const {
    integrator::PhotonPlan plan;
    plan.photons = emitted;
    PhotonEmission emission(plan, sample);
    uint64_t rays = 0;
    const double tracing = seconds([&] {
      for (int i = 0; i < plan.tasks(); ++i) rays += *emission.run(context(), PhotonEmission::kTrace, i, {});
    });
    const double ordering = seconds([&] {
      emission.finish(PhotonEmission::kTrace);
      for (int i = 0; i < photon::PhotonMap::kPieces; ++i) emission.run(context(), PhotonEmission::kBuild, i, {});
      emission.finish(PhotonEmission::kBuild);
    });
    const photon::PhotonMap& map = emission.map();
    constexpr size_t kLookups = 20'000;
    photon::Neighbourhood nearest;
    const double looking = seconds([&] {
      for (size_t i = 0; i < kLookups; ++i) {
        const photon::Photon& p = map[i * map.size() / kLookups];
        map.find_nearest(p.position(), p.normal(), 50, kInfinity, nearest);
      }
    });
    return {static_cast<double>(rays) / tracing, ordering, 1e6 * looking / kLookups, map.size()};
  }

 private:
  integrator::RenderContext context() const {
    return {scene_.get(), &model_, sampler_.get(), &camera_, &filter_, 0, kSize, kSize};
  }

  render::Document document_;
  std::shared_ptr<const scene::CompiledScene> scene_;
  transport::Model model_;
  std::unique_ptr<Sampler> sampler_;
  CameraRays camera_;
  film::Filter filter_;
  std::unique_ptr<integrator::Integrator> path_;
  std::unique_ptr<integrator::RenderState> work_;
};

void run() {
  const Rig rig;
  std::printf("photons    stored  Mrays/s of path  of photons  ratio  ordering ms  ns/photon  us/lookup of 50\n");
  for (const int emitted : {10'000, 100'000, 500'000}) {
    double paths = 0, rays = 0, ordering = 1e9, lookup = 1e9;
    size_t stored = 0;
    for (uint32_t task_context = 0; task_context < 5; ++task_context) {
      paths = std::max(paths, rig.paths(task_context));
      const Rig::Photons found = rig.photons(emitted, task_context);
      rays = std::max(rays, found.rays_per_second);
      ordering = std::min(ordering, found.ordering);
      lookup = std::min(lookup, found.microseconds_a_lookup);
      stored = found.stored;
    }
    std::printf("%7d  %8zu  %15.2f  %10.2f  %5.2f  %11.1f  %11.0f  %17.1f\n", emitted, stored, 1e-6 * paths,
                1e-6 * rays, rays / paths, 1e3 * ordering, 1e9 * ordering / static_cast<double>(stored), lookup);
  }
}

}  // namespace
}  // namespace etendue

int main() { etendue::run(); }
