// Photon tracing.                                            [Lang, sec. 9.5, eq. 9.125, 9.126, corrected; Jensen 2001]
//
// All photons of an emission have about the same power: lights are chosen in proportion to theirs, and Russian roulette
// is applied from the first vertex on. Photons are stored at every hit of a surface with rough lobes
// (transport/wavefront/lobe_split.h), even if they continue by a near-specular lobe: the estimate multiplies them by
// the rough lobes as a whole.
//
// In scattering media, photons are also stored at collisions [Jensen and Christensen 1998]. A free flight has
// collisions with the density sigma_t exp(-tau), and the throughput at a collision contains the albedo. The powers of
// the photons in a region therefore sum to the power that is scattered in it, the integral of sigma_s times the
// fluence. Stored powers are divided by the scattering coefficient at their collisions, so that the sum is the integral
// of the fluence, in lm m, and photons of a dense medium are not counted in a thin one beside it.
//
// The caustics map contains photons that have been scattered by near-specular lobes only, at least once: D_G S_G+ L,
// from the camera. No light samples find media that emit, so photons that start in media are stored one edge earlier
// than others: the map contains D_G S_G* L for them.
#pragma once
#include "integrator/photon/photon.h"
#include "integrator/shared/light_subpaths.h"
#include "integrator/shared/random_subset.h"
#include "transport/path_expression/join_weights.h"
#include "transport/wavefront/lobe_split.h"

namespace etendue::integrator {

// The photons to be traced, and those to be stored.
struct PhotonPlan {
  int photons = 0;  // emitted by the lights
  transport::LobeSplit split{0.0f};
  bool caustics = false;
  int min_length = 1;         // number of edges at which photons are stored on surfaces
  int min_volume_length = 0;  // the same for collisions in media; 0: none are stored
  int max_length = 0;         // 0: no limit

  // `from_medium`: the path starts in a medium that emits light.
  bool stores_on_surfaces(int length, bool from_medium) const { return length + (from_medium ? 1 : 0) >= min_length; }
  bool stores_in_volumes(int length, bool from_medium) const {
    return min_volume_length > 0 && length + (from_medium ? 1 : 0) >= min_volume_length;
  }

  static constexpr int kTask = SampleTable::kPaths;
  int tasks() const { return (photons + kTask - 1) / kTask; }

  friend bool operator==(const PhotonPlan&, const PhotonPlan&) = default;
};

// A path through milk has hundreds of collisions: the mean number of photons that a light path stores in media is at
// most this.
inline constexpr size_t kMostVolumePhotonsPerPath = 16;

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

// The photons of some light paths.
struct StoredPhotons {
  std::vector<photon::Photon> surfaces, volumes;
};

// Where a photon of a current hit is stored; null if it is not.
template <class M>
std::vector<photon::Photon>* list_for(const PhotonPlan& plan, const LightSubpaths<M>& subpaths,
                                      const transport::PathWavefront<M>& paths, int hit, StoredPhotons& photons) {
  const bool from_medium = subpaths.starts_in_medium(paths.path_at(hit));
  if (paths.in_volume(hit)) return plan.stores_in_volumes(paths.length(), from_medium) ? &photons.volumes : nullptr;
  const bool is_stored = plan.stores_on_surfaces(paths.length(), from_medium) && plan.split.has_rough(paths.bsdf(hit));
  return is_stored ? &photons.surfaces : nullptr;
}

template <class M>
void store_photons(const PhotonPlan& plan, const LightSubpaths<M>& subpaths, transport::PathWavefront<M>& paths,
                   StoredPhotons& photons) {
  using namespace transport;
  const bool media_emit = paths.scene().solids().any_medium_emits();
  if (!plan.stores_on_surfaces(paths.length(), media_emit) && !plan.stores_in_volumes(paths.length(), media_emit))
    return;
  if constexpr (M::kClasses) paths.draw(dimensions(vertex_dimension::kLightChoice, 1));
  const PackedVertices packed(paths);
  const float share = 1 / static_cast<float>(plan.photons);
  for (int i = 0; i < paths.hit_count(); ++i) {
    std::vector<photon::Photon>* list = list_for(plan, subpaths, paths, i, photons);
    if (!list) continue;
    const int path = paths.path_at(i);
    auto power = paths.state(path).throughput * (subpaths.flux(path) * share);
    uint8_t state = 0;
    if constexpr (M::kClasses) {
      const auto drawn = draw_state(paths.shares(), path, paths.random(vertex_dimension::kLightChoice, i));
      if (is_black(drawn.weight)) continue;
      power *= drawn.weight;
      state = drawn.state;
    }
    if constexpr (M::kScattering)
      if (paths.in_volume(i)) power = ratio(power, paths.collision(i).scattering);
    const auto hit = static_cast<size_t>(i);
    list->emplace_back(paths.point(i).position, packed.directions[hit], packed.normals[hit], power, paths.length(),
                       state);
  }
}

// Traces the photons of one task of a sample. Returns the number of rays, or nothing if it was cancelled.
template <class M>
std::optional<uint64_t> trace_photons(const RenderContext& context, uint32_t sample, const PhotonPlan& plan, int task,
                                      const TaskContext& task_context, StoredPhotons& photons) {
  using namespace transport;
  static thread_local const auto subpaths = std::make_unique<LightSubpaths<M>>();
  static thread_local StoredPhotons stored;
  PathWavefront<M>& paths = thread_wavefront<M>();
  stored.surfaces.clear();
  stored.volumes.clear();
  const int first = task * PhotonPlan::kTask;
  constexpr uint32_t kCausticSeed = 1U << 31;  // makes paths of both maps independent
  const uint32_t start = static_cast<uint32_t>(first) + (plan.caustics ? kCausticSeed : 0);
  subpaths->launch(
      context, sample, std::min(PhotonPlan::kTask, plan.photons - first), task_context, paths,
      [&](int i) { return start + static_cast<uint32_t>(i); }, [](auto&&...) { return true; },
      LightPathStarts::anywhere);
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
  photons.surfaces.assign(stored.surfaces.begin(), stored.surfaces.end());
  if constexpr (M::kScattering)
    thin_randomly(
        stored.volumes, kMostVolumePhotonsPerPath * PhotonPlan::kTask,
        hash_combine(light_path_seed(context.seed, start, sample % film::kHalfBuffers), sample / film::kHalfBuffers),
        [](photon::Photon& photon, float factor) { photon.scale_power(factor); });
  photons.volumes.assign(stored.volumes.begin(), stored.volumes.end());
  return paths.rays_traced();
}

}  // namespace etendue::integrator
