#include "integrator/path/transport_terms.h"

#include "integrator/shared/camera_paths.h"
#include "transport/wavefront/medium_light.h"
#include "transport/wavefront/subsurface_scattering.h"

namespace etendue::integrator {
namespace {

using TermModel = transport::ScatteringMedia<false>;
using TermPaths = transport::PathWavefront<TermModel>;

constexpr transport::MisHeuristic kTermHeuristic = transport::MisHeuristic::power;
constexpr int kTermRouletteStart = 4;

// Path tracing after the first segment, which has been traced. If `from_volume`, only paths whose first vertex lies in
// a volume contribute; otherwise emission of media on the first segment is left out.
void trace_remaining_paths(TermPaths& paths, int max_depth, bool from_volume) {
  using namespace transport;
  MediumLight<TermModel> media(paths, Combination(kTermHeuristic));
  do {
    const bool first = paths.length() == 1;
    if (!first || !from_volume) add_environment(paths, kTermHeuristic);
    if (!first) media.add_emission_of_misses();
    while (paths.next_hits()) {
      if (first && from_volume) {
        for (int i = 0; i < paths.hit_count(); ++i)
          if (!paths.in_volume(i)) paths.state_at(i).throughput = Rgb(0);
      } else {
        if (!first) media.add_emission_before_hits();
        add_emission(paths, kTermHeuristic);
      }
      if (max_depth > 0 && paths.length() >= max_depth) continue;
      scatter_below_surface(paths);
      add_direct_light(paths, LightStrategy::automatic, kTermHeuristic);
      media.add_light_samples();
      sample_bsdf_where(
          paths, kTermRouletteStart, TransportMode::radiance,
          [&](int i) { return !is_black(paths.state_at(i).throughput); }, [](int, const auto&) {});
    }
  } while (paths.trace());
}

// The surface seen without media, and what the media before it change.
void sample_surface(TermPaths& paths, int max_depth, const PixelOrder& order, std::span<TransportTerms> terms,
                    uint64_t& rays) {
  paths.ignore_collisions(true);
  if (!paths.trace()) return;
  paths.ignore_collisions(false);
  std::array<transport::MediumLightOnRay, TermPaths::kCapacity> media;
  for (int i = 0; i < paths.size(); ++i) {
    const auto path = static_cast<size_t>(i);
    media[path] = transport::medium_light_on_ray(paths.scene(), paths.media().ray(i), paths.opacity_seed(i) + 1,
                                                 paths.state(i).time, paths.media().stack(i),
                                                 transport::EmissionPoints::of_voxels);
    rays += media[path].rays;
    paths.state(i).throughput = Rgb(1);
  }
  trace_remaining_paths(paths, max_depth, false);
  for (int i = 0; i < paths.size(); ++i) {
    const transport::MediumLightOnRay& light = media[static_cast<size_t>(i)];
    const Rgb surface = paths.state(i).radiance;
    TransportTerms& term = terms[order.index(i)];
    term.surface = surface;
    term.absorption = surface * light.absorbed;
    term.out_scattering = surface * light.scattered;
    term.emission = light.emitted;
  }
}

}  // namespace

std::optional<uint64_t> sample_transport_terms(const RenderContext& context, const PixelBlock& block, int max_depth,
                                               const TaskContext& task_context, std::span<TransportTerms> terms) {
  TermPaths& paths = thread_wavefront<TermModel>();
  const PixelOrder order(block);
  uint64_t rays = 0;
  launch_camera_paths(context, block, order, task_context, paths);
  sample_surface(paths, max_depth, order, terms, rays);
  rays += paths.rays_traced();
  if (paths.cancelled()) return {};

  launch_camera_paths(context, block, order, task_context, paths);
  paths.stratify_channels();
  if (paths.trace()) trace_remaining_paths(paths, max_depth, true);
  if (paths.cancelled()) return {};
  for (int i = 0; i < paths.size(); ++i) terms[order.index(i)].in_scattering = paths.state(i).radiance;
  return rays + paths.rays_traced();
}

}  // namespace etendue::integrator
