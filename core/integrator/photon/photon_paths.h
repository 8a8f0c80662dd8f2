// Photon tracing.                                            [Lang, sec. 9.5, eq. 9.125, 9.126, corrected; Jensen 2001]
//
// All photons of an emission have about the same power: lights are chosen in proportion to theirs, and Russian roulette
// is applied from the first vertex on. Photons are stored at every hit of a surface with rough lobes
// (transport/wavefront/lobe_split.h), even if they continue by a near-specular lobe: the estimate multiplies them by
// the rough lobes as a whole.
//
// The caustics map contains photons that have been scattered by near-specular lobes only, at least once: D_G S_G+ L,
// from the camera.
#pragma once
#include "integrator/photon/photon.h"
#include "integrator/shared/light_subpaths.h"
#include "transport/path_expression/join_weights.h"
#include "transport/wavefront/lobe_split.h"

namespace etendue::integrator {

// The photons to be traced, and those to be stored.
struct PhotonPlan {
  int photons = 0;  // emitted by the lights
  transport::LobeSplit split{0.0f};
  bool caustics = false;
  int min_length = 1;  // number of edges at which photons are stored
  int max_length = 0;  // 0: no limit
  static constexpr int kTask = SampleTable::kPaths;
  int tasks() const { return (photons + kTask - 1) / kTask; }

  friend bool operator==(const PhotonPlan&, const PhotonPlan&) = default;
};

// Normals and directions of the current hits, packed as in photons.
struct PackedVertices {
  static constexpr size_t kSize = 64;
  std::array<uint32_t, kSize> normals, directions;

  template <class M>
  explicit PackedVertices(const transport::PathWavefront<M>& paths) {
    static_assert(kSize == transport::PathWavefront<M>::kHitsAtATime);
    Vec3Lanes<kSize> normal, direction;
    for (int i = 0; i < paths.hit_count(); ++i) {
      normal.set(static_cast<size_t>(i), paths.point(i).ng);
      direction.set(static_cast<size_t>(i), paths.wo(i));
    }
    const auto count = static_cast<size_t>(paths.hit_count());
    photon::pack_directions(normal, count, photon::Photon::kNormalBits, normals.data());
    photon::pack_directions(direction, count, photon::Photon::kDirectionBits, directions.data());
  }
};

template <class M>
void store_photons(const PhotonPlan& plan, const LightSubpaths<M>& subpaths, transport::PathWavefront<M>& paths,
                   std::vector<photon::Photon>& photons) {
  using namespace transport;
  if (paths.length() < plan.min_length) return;
  if constexpr (M::kClasses) paths.draw(dimensions(vertex_dimension::kLightChoice, 1));
  const PackedVertices packed(paths);
  const float share = 1 / static_cast<float>(plan.photons);
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!plan.split.has_rough(paths.bsdf(i))) continue;
    const int path = paths.path_at(i);
    auto power = paths.state(path).throughput * (subpaths.flux(path) * share);
    uint8_t state = 0;
    if constexpr (M::kClasses) {
      const auto drawn = draw_state(paths.shares(), path, paths.random(vertex_dimension::kLightChoice, i));
      if (is_black(drawn.weight)) continue;
      power *= drawn.weight;
      state = drawn.state;
    }
    const auto hit = static_cast<size_t>(i);
    photons.emplace_back(paths.point(i).position, packed.directions[hit], packed.normals[hit], power, paths.length(),
                         state);
  }
}

// Traces the photons of one task of a sample. Returns the number of rays, or nothing if it was cancelled.
template <class M>
std::optional<uint64_t> trace_photons(const RenderContext& context, uint32_t sample, const PhotonPlan& plan, int task,
                                      const TaskContext& task_context, std::vector<photon::Photon>& photons) {
  using namespace transport;
  static thread_local const auto subpaths = std::make_unique<LightSubpaths<M>>();
  static thread_local std::vector<photon::Photon> stored;
  PathWavefront<M>& paths = thread_wavefront<M>();
  stored.clear();
  const int first = task * PhotonPlan::kTask;
  constexpr uint32_t kCausticSeed = 1U << 31;  // makes paths of both maps independent
  const uint32_t start = static_cast<uint32_t>(first) + (plan.caustics ? kCausticSeed : 0);
  subpaths->launch(
      context, sample, std::min(PhotonPlan::kTask, plan.photons - first), task_context, paths,
      [&](int i) { return start + static_cast<uint32_t>(i); }, [](auto&&...) { return true; });
  while (paths.trace())
    while (paths.next_hits()) {
      if (paths.length() == 1) subpaths->apply_range_window(paths);
      store_photons(plan, *subpaths, paths, stored);
      if (plan.max_length > 0 && paths.length() >= plan.max_length) continue;
      if (plan.caustics)
        sample_bsdf(paths, 1, TransportMode::importance, AcceptNearSpecular{plan.split, TransportMode::importance});
      else
        sample_bsdf(paths, 1, TransportMode::importance);
    }
  if (paths.cancelled()) return {};
  photons.assign(stored.begin(), stored.end());
  return paths.rays_traced();
}

}  // namespace etendue::integrator
