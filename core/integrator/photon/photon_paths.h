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
  explicit PackedArrivals(const transport::Front<M>& front) {
    static_assert(kSize == transport::Front<M>::kArrivals);
    WideVec3<kSize> normal, direction;
    for (int i = 0; i < front.arrived(); ++i)
      normal.set(static_cast<size_t>(i), front.point(i).ng), direction.set(static_cast<size_t>(i), front.wo(i));
    const auto count = static_cast<size_t>(front.arrived());
    photon::packed_directions(normal, count, photon::Photon::kNormalBits, normals.data());
    photon::packed_directions(direction, count, photon::Photon::kDirectionBits, directions.data());
  }
};

template <class M>
void store_photons(const PhotonPlan& plan, const LightWalks<M>& walks, transport::Front<M>& front,
                   std::vector<photon::Photon>& photons) {
  using namespace transport;
  if (front.length() < plan.shortest) return;
  if constexpr (M::kClasses) front.draw(dimensions(vertex_dimension::kLightChoice, 1));
  const PackedArrivals packed(front);
  const float share = 1 / static_cast<float>(plan.photons);
  for (int i = 0; i < front.arrived(); ++i) {
    if (!plan.split.has_wide(front.bsdf(i))) continue;
    const int path = front.path_at(i);
    auto power = front.state(path).throughput * (walks.flux(path) * share);
    uint8_t state = 0;
    if constexpr (M::kClasses) {
      const auto drawn = draw_state(front.shares(), path, front.random(vertex_dimension::kLightChoice, i));
      if (is_black(drawn.weight)) continue;
      power *= drawn.weight, state = drawn.state;
    }
    const auto arrival = static_cast<size_t>(i);
    photons.emplace_back(front.point(i).position, packed.directions[arrival], packed.normals[arrival], power,
                         front.length(), state);
  }
}

// Traces the photons of one task of a sample; the number of rays, or nothing if they were given up.
template <class M>
std::optional<uint64_t> trace_photons(const Pass& pass, uint32_t sample, const PhotonPlan& plan, int task,
                                      const Turn& turn, std::vector<photon::Photon>& photons) {
  using namespace transport;
  static thread_local const auto walks = std::make_unique<LightWalks<M>>();
  static thread_local std::vector<photon::Photon> stored;
  Front<M>& front = front_of_thread<M>();
  stored.clear();
  const int first = task * PhotonPlan::kTask;
  constexpr uint32_t kCaustics = 1U << 31;  // others than those of the global map
  const uint32_t start = static_cast<uint32_t>(first) + (plan.caustics ? kCaustics : 0);
  walks->launch(
      pass, sample, std::min(PhotonPlan::kTask, plan.photons - first), turn, front,
      [&](int i) { return start + static_cast<uint32_t>(i); }, [](auto&&...) { return true; });
  while (front.advance())
    while (front.arrive()) {
      if (front.length() == 1) walks->dim_first_vertices(front);
      store_photons(plan, *walks, front, stored);
      if (plan.longest > 0 && front.length() >= plan.longest) continue;
      if (plan.caustics)
        scatter(front, 1, Transport::importance, TakeNarrow{plan.split, Transport::importance});
      else
        scatter(front, 1, Transport::importance);
    }
  if (front.given_up()) return {};
  photons.assign(stored.begin(), stored.end());
  return front.rays_traced();
}

}  // namespace etendue::integrator
