// Photons: what lights send out, stored where it arrives.             thesis 9.5, (9.125), (9.126), erratum E32;
// S30-S32
//
// Every photon of an emission stands for about the same power: lights are chosen by theirs, and roulette by albedo is
// played from the first vertex on. Each arrival at a surface with a wide part (transport/lobe_split.h) is stored, also
// of those that go on by a narrow part: what multiplies them later is the whole of the wide part.
//
// The caustics map has what came by narrow parts alone, one at least: D_G S_G+ L, read from the camera.
#pragma once
#include "integrator/photon/photon.h"
#include "integrator/shared/light_subpaths.h"
#include "transport/path_expression/join_weights.h"
#include "transport/wavefront/lobe_split.h"

namespace etendue::integrator {

// Which photons are traced, and which of them are stored.
struct PhotonPlan {
  int photons = 0;  // that leave the lights
  transport::LobeSplit split{0.0f};
  bool caustics = false;
  int shortest = 1;  // edges of a path whose end is stored
  int longest = 0;   // 0: no limit
  static constexpr int kTask = SampleTable::kPaths;
  int tasks() const { return (photons + kTask - 1) / kTask; }

  friend bool operator==(const PhotonPlan&, const PhotonPlan&) = default;
};

// Normals and directions of the present vertices, packed as photons keep them.
struct PackedArrivals {
  static constexpr size_t kSize = 64;
  std::array<uint32_t, kSize> normals, directions;

  template <class M>
  explicit PackedArrivals(const transport::PathWavefront<M>& paths) {
    static_assert(kSize == transport::PathWavefront<M>::kHitsAtATime);
    Vec3Lanes<kSize> normal, direction;
    for (int i = 0; i < paths.hit_count(); ++i)
      normal.set(static_cast<size_t>(i), paths.point(i).ng), direction.set(static_cast<size_t>(i), paths.wo(i));
    const auto count = static_cast<size_t>(paths.hit_count());
    photon::packed_directions(normal, count, photon::Photon::kNormalBits, normals.data());
    photon::packed_directions(direction, count, photon::Photon::kDirectionBits, directions.data());
  }
};

template <class M>
void store_photons(const PhotonPlan& plan, const LightSubpaths<M>& walks, transport::PathWavefront<M>& paths,
                   std::vector<photon::Photon>& photons) {
  using namespace transport;
  if (paths.length() < plan.shortest) return;
  if constexpr (M::kClasses) paths.draw(dimensions(vertex_dimension::kLightChoice, 1));
  const PackedArrivals packed(paths);
  const float share = 1 / static_cast<float>(plan.photons);
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!plan.split.has_rough(paths.bsdf(i))) continue;
    const int path = paths.path_at(i);
    auto power = paths.state(path).throughput * (walks.flux(path) * share);
    uint8_t state = 0;
    if constexpr (M::kClasses) {
      const auto drawn = draw_state(paths.shares(), path, paths.random(vertex_dimension::kLightChoice, i));
      if (is_black(drawn.weight)) continue;
      power *= drawn.weight, state = drawn.state;
    }
    const auto hit = static_cast<size_t>(i);
    photons.emplace_back(paths.point(i).position, packed.directions[hit], packed.normals[hit], power, paths.length(),
                         state);
  }
}

// Traces the photons of one task of a sample; the number of rays, or nothing if they were given up.
template <class M>
std::optional<uint64_t> trace_photons(const RenderContext& context, uint32_t sample, const PhotonPlan& plan, int task,
                                      const TaskContext& task_context, std::vector<photon::Photon>& photons) {
  using namespace transport;
  static thread_local const auto walks = std::make_unique<LightSubpaths<M>>();
  static thread_local std::vector<photon::Photon> stored;
  PathWavefront<M>& paths = thread_wavefront<M>();
  stored.clear();
  const int first = task * PhotonPlan::kTask;
  constexpr uint32_t kCaustics = 1U << 31;  // others than those of the global map
  const uint32_t start = static_cast<uint32_t>(first) + (plan.caustics ? kCaustics : 0);
  walks->launch(
      context, sample, std::min(PhotonPlan::kTask, plan.photons - first), task_context, paths,
      [&](int i) { return start + static_cast<uint32_t>(i); }, [](auto&&...) { return true; });
  while (paths.trace())
    while (paths.next_hits()) {
      if (paths.length() == 1) walks->dim_first_vertices(paths);
      store_photons(plan, *walks, paths, stored);
      if (plan.longest > 0 && paths.length() >= plan.longest) continue;
      if (plan.caustics)
        sample_bsdf(paths, 1, TransportMode::importance, TakeNearSpecular{plan.split, TransportMode::importance});
      else
        sample_bsdf(paths, 1, TransportMode::importance);
    }
  if (paths.cancelled()) return {};
  photons.assign(stored.begin(), stored.end());
  return paths.rays_traced();
}

}  // namespace etendue::integrator
