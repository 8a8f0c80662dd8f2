// Radiance estimates from photons, for the rough lobes of surfaces (transport/wavefront/lobe_split.h).
//                                                                                    [Lang, eq. 9.127-9.138, corrected]
//
//   L_o = 1 / (pi r^2)  sum of f(w_photon, w_o) Phi
//
// over the photons in a disc of radius r. The photon density follows the geometric surface, but f the shading normal:
// each photon is weighted by the ratio of its cosines to both normals, as in path tracing.
#pragma once
#include "base/stopwatch.h"
#include "integrator/photon/kernel.h"
#include "integrator/photon/photon_map.h"
#include "transport/path_expression/join_weights.h"
#include "transport/wavefront/lobe_split.h"

namespace etendue::integrator {

// The photons of a lookup, and their limits.
struct PhotonView {
  const photon::PhotonMap* map = nullptr;
  transport::LobeSplit split{0.0f};
  const transport::ClassJoin* join = nullptr;  // in a model with path classes
  int max_length = 0;                          // edges of a whole path; 0: no limit
  Stopwatch* watch = nullptr;                  // runs during photon lookups
};

// The reflection of photons at a vertex that is `edges` edges from the camera.
template <class M>
class PhotonReflection {
 public:
  using Color = typename M::Color;

  PhotonReflection(transport::PathWavefront<M>& paths, int hit, const PhotonView& view, int edges)
      : bsdf_(paths.bsdf(hit)), wo_(paths.wo(hit)), ng_(paths.point(hit).ng), view_(view), edges_(edges) {
    has_geometric_normal_ = bsdf_.frame().z == ng_;
    if constexpr (M::kClasses) transport::find_join_weights(paths.shares(), paths.path_at(hit), *view.join, weights_);
  }

  // f Phi
  Color reflected(const photon::Photon& photon) const {
    if (view_.max_length > 0 && edges_ + photon.length() > view_.max_length) return Color(0);
    const Vec3 wi = photon.direction();
    Color f;
    if constexpr (M::kClasses)
      f = value_by_letter(wi, weights_.by_state[photon.state()]);
    else
      f = view_.split.rough_value(bsdf_, wo_, wi, TransportMode::radiance);
    // Directions along the surface are as rare as their ratio of cosines is large: the cosine is bounded from below.
    constexpr float kMinCosine = 1e-3f;
    const float cosines =
        has_geometric_normal_ ? 1 : bsdf_.cosine(wi) / std::max(std::abs(glm::dot(ng_, wi)), kMinCosine);
    return f * photon.power() * cosines;
  }

 private:
  Color value_by_letter(const Vec3& wi, const typename transport::JoinWeights<Color>::ByLetter& weight) const {
    Color f(0);
    if (bsdf_.has_component(ScatterType::diffuse))
      f = bsdf_.eval_component(ScatterType::diffuse, wo_, wi) * weight.diffuse;
    if (bsdf_.has_component(ScatterType::glossy) && view_.split.gloss_is_rough(bsdf_))
      f += bsdf_.eval_component(ScatterType::glossy, wo_, wi) * weight.glossy;
    return f;
  }

  struct Empty {};
  const Bsdf<M>& bsdf_;
  const Vec3 &wo_, &ng_;
  const PhotonView& view_;
  int edges_;
  bool has_geometric_normal_;
  [[no_unique_address]] std::conditional_t<M::kClasses, transport::JoinWeights<Color>, Empty> weights_;
};

// The number of photons in an estimate, and their maximum squared distance.
struct NearestPhotons {
  size_t count = 2;
  float max_distance2 = kInfinity;
  photon::Kernel kernel = photon::Kernel::constant;
};

// Adds the light that the current hits reflect, with the nearest photons. `before` is the number of edges between the
// camera and the start of these paths.
template <class M, class Selected = transport::EveryHit>
void add_nearest_photons(transport::PathWavefront<M>& paths, const PhotonView& view, const NearestPhotons& nearest,
                         int before, const Selected& selected = {}) {
  static thread_local std::vector<photon::Neighbour> neighbours;
  const Stopwatch::Lap lap(view.watch);
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!selected(i) || !view.split.has_rough(paths.bsdf(i))) continue;
    const scene::SurfacePoint& point = paths.point(i);
    const auto neighbourhood =
        view.map->nearest(point.position, point.ng, nearest.count, nearest.max_distance2, neighbours);
    if (neighbourhood.photons.empty()) continue;
    const PhotonReflection<M> reflection(paths, i, view, before + paths.length());
    typename M::Color sum(0);
    for (const photon::Neighbour& n : neighbourhood.photons)
      sum += reflection.reflected((*view.map)[n.photon]) *
             kernel_weight(nearest.kernel, n.distance2 / neighbourhood.radius2);
    auto& path = paths.state_at(i);
    path.radiance += path.throughput * sum / (kPi * neighbourhood.radius2);
  }
}

// The same with all photons within a radius: `radius2(i)` is the squared radius of hit i.
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
                              [&](const photon::Photon& photon, float) { sum += reflection.reflected(photon); });
    auto& path = paths.state_at(i);
    path.radiance += path.throughput * sum / (kPi * r2);
  }
}

}  // namespace etendue::integrator
