// What the wide part of surfaces reflects of the light that photons brought.         thesis (9.127)-(9.138), E31; S33
//
//   L_o = 1 / (pi r^2)  sum of f(w_photon, w_o) Phi
//
// with the photons in a disc of radius r around. Photons lie as densely as light falls onto the real surface, while f
// belongs to the shading normal: each counts with the ratio of its cosines to both, as in path tracing.
#pragma once
#include "base/stopwatch.h"
#include "integrator/photon/kernel.h"
#include "integrator/photon/photon_map.h"
#include "transport/path_expression/join_weights.h"
#include "transport/wavefront/lobe_split.h"

namespace etendue::integrator {

// Which photons count, whatever vertex looks them up.
struct PhotonView {
  const photon::PhotonMap* map = nullptr;
  transport::LobeSplit split{0.0f};
  const transport::ClassJoin* join = nullptr;  // in a model with path classes
  int longest = 0;                             // edges of a whole path; 0: no limit
  Stopwatch* watch = nullptr;                  // runs while photons are looked up
};

// One vertex, `edges` from the camera, for all photons around it.
template <class M>
class PhotonReflection {
 public:
  using Color = typename M::Color;

  PhotonReflection(transport::PathWavefront<M>& paths, int hit, const PhotonView& view, int edges)
      : bsdf_(paths.bsdf(hit)), wo_(paths.wo(hit)), ng_(paths.point(hit).ng), view_(view), edges_(edges) {
    flat_ = bsdf_.frame().z == ng_;
    if constexpr (M::kClasses) transport::find_join_weights(paths.shares(), paths.path_at(hit), *view.join, weights_);
  }

  // f Phi
  Color of(const photon::Photon& photon) const {
    if (view_.longest > 0 && edges_ + photon.length() > view_.longest) return Color(0);
    const Vec3 wi = photon.direction();
    Color f;
    if constexpr (M::kClasses)
      f = admitted(wi, weights_.of[photon.state()]);
    else
      f = view_.split.wide(bsdf_, wo_, wi, TransportMode::radiance);
    // Directions along the surface are as rare as they are heavy.
    constexpr float kLeast = 1e-3f;
    const float cosines = flat_ ? 1 : bsdf_.cosine(wi) / std::max(std::abs(glm::dot(ng_, wi)), kLeast);
    return f * photon.power() * cosines;
  }

 private:
  Color admitted(const Vec3& wi, const typename transport::JoinWeights<Color>::ByLetter& weight) const {
    Color f(0);
    if (bsdf_.has_component(ScatterType::diffuse))
      f = bsdf_.eval_component(ScatterType::diffuse, wo_, wi) * weight.diffuse;
    if (bsdf_.has_component(ScatterType::glossy) && view_.split.gloss_is_rough(bsdf_))
      f += bsdf_.eval_component(ScatterType::glossy, wo_, wi) * weight.glossy;
    return f;
  }

  struct Nothing {};
  const Bsdf<M>& bsdf_;
  const Vec3 &wo_, &ng_;
  const PhotonView& view_;
  int edges_;
  bool flat_;
  [[no_unique_address]] std::conditional_t<M::kClasses, transport::JoinWeights<Color>, Nothing> weights_;
};

// How many photons an estimate takes, and from how far.
struct NearestPhotons {
  size_t most = 2;
  float farthest2 = kInfinity;
  photon::Kernel kernel = photon::Kernel::constant;
};

// Adds what the arrivals reflect. They are `before` more edges from the camera than the front says.
template <class M, class Selected = transport::EveryHit>
void add_nearest_photons(transport::PathWavefront<M>& paths, const PhotonView& view, const NearestPhotons& nearest,
                         int before, const Selected& selected = {}) {
  static thread_local std::vector<photon::Neighbour> room;
  const Stopwatch::Lap lap(view.watch);
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!selected(i) || !view.split.has_rough(paths.bsdf(i))) continue;
    const scene::SurfacePoint& point = paths.point(i);
    const auto around = view.map->nearest(point.position, point.ng, nearest.most, nearest.farthest2, room);
    if (around.photons.empty()) continue;
    const PhotonReflection<M> reflection(paths, i, view, before + paths.length());
    typename M::Color sum(0);
    for (const photon::Neighbour& n : around.photons)
      sum += reflection.of((*view.map)[n.photon]) * kernel_weight(nearest.kernel, n.distance2 / around.radius2);
    auto& path = paths.state_at(i);
    path.radiance += path.throughput * sum / (kPi * around.radius2);
  }
}

// The same with a radius that every arrival has of its own: `radius2(i)`.
template <class M, class Radius2>
void add_photons_within(transport::PathWavefront<M>& paths, const PhotonView& view, const Radius2& radius2) {
  const Stopwatch::Lap lap(view.watch);
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!view.split.has_rough(paths.bsdf(i))) continue;
    const scene::SurfacePoint& point = paths.point(i);
    const PhotonReflection<M> reflection(paths, i, view, paths.length());
    const float r2 = radius2(i);
    typename M::Color sum(0);
    view.map->for_each_within(point.position, point.ng, r2,
                              [&](const photon::Photon& photon, float) { sum += reflection.of(photon); });
    auto& path = paths.state_at(i);
    path.radiance += path.throughput * sum / (kPi * r2);
  }
}

}  // namespace etendue::integrator
