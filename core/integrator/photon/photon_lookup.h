// Radiance estimates from photons, for the rough lobes of surfaces (transport/wavefront/lobe_split.h) and for phase
// functions.
//                                                                                    [Lang, eq. 9.127-9.138, corrected]
//
//   L_o = 1 / (pi r^2)  sum of f(w_photon, w_o) Phi
//
// over the photons in a disc of radius r, and in scattering media, without the factor sigma_s of the throughput,
//
//   L_s = 1 / (4/3 pi r^3)  sum of p(w_photon, w_o) Phi / sigma_s                        [Jensen and Christensen 1998]
//
// over those in a ball. The photon density follows the geometric surface, but f the shading normal:
// each photon is weighted by the ratio of its cosines to both normals, as in path tracing.
#pragma once
#include <limits>

#include "base/stopwatch.h"
#include "integrator/photon/kernel.h"
#include "integrator/photon/photon_map.h"
#include "integrator/photon/shallow_collisions.h"
#include "transport/path_expression/join_weights.h"

namespace etendue::integrator {

// The photons of a lookup, and their limits.
struct PhotonView {
  const photon::PhotonMap* map = nullptr;
  transport::LobeSplit split{0.0f};
  const transport::ClassJoin* join = nullptr;     // in a model with path classes
  int max_length = 0;                             // edges of a whole path; 0: no limit
  Stopwatch* watch = nullptr;                     // runs during photon lookups
  const photon::PhotonMap* volume_map = nullptr;  // of photons in media; null: not looked up
};

// The reflection of photons at a surface vertex that is `edges` edges from the camera.
template <class M>
class PhotonReflection {
 public:
  using Color = typename M::Color;

  PhotonReflection(transport::PathWavefront<M>& paths, int hit, const PhotonView& view, int edges)
      : bsdf_(surface_of(paths.bsdf(hit))), wo_(paths.wo(hit)), ng_(paths.point(hit).ng), view_(view), edges_(edges) {
    has_geometric_normal_ = bsdf_.frame().z == ng_;
    is_lambertian_ = has_geometric_normal_ && has_only_lambertian_lobe();
    if (is_lambertian_) lambertian_value_ = bsdf_.eval(wo_, wo_);
    if constexpr (M::kClasses) transport::find_join_weights(paths.shares(), paths.path_at(hit), *view.join, weights_);
  }

  // Whether f is constant for all directions that are reflected, which is its value for the view direction.
  bool is_lambertian() const { return is_lambertian_; }
  // The sum of f Phi of all photons within a radius around the vertex, if it is Lambertian.
  Color reflected_within(const Vec3& position, float radius2) const {
    const photon::LambertianLookup lookup{.position = position,
                                          .normal = ng_,
                                          .radius2 = radius2,
                                          .side = glm::dot(ng_, wo_),
                                          .max_length = max_photon_length()};
    return lambertian_value_ * view_.map->sum_of_powers(lookup);
  }

  // f Phi
  Color reflected(const photon::Photon& photon) const {
    if (view_.max_length > 0 && edges_ + photon.length() > view_.max_length) return Color(0);
    if (is_lambertian_)
      return glm::dot(photon.unnormalized_direction(), ng_) * glm::dot(ng_, wo_) > 0
                 ? lambertian_value_ * photon.power()
                 : Color(0);
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
  using SurfaceBsdf = Bsdf<typename M::Surfaces>;

  static const SurfaceBsdf& surface_of(const Bsdf<M>& bsdf) {
    if constexpr (M::kScattering)
      return bsdf.surface();
    else
      return bsdf;
  }

  bool has_only_lambertian_lobe() const {
    if constexpr (M::kClasses)
      return false;
    else if constexpr (M::kDiffuse)
      return true;
    else if constexpr (requires { bsdf_.lobes.template single_lobe_as<Lambert<Color>>(); })
      return bsdf_.lobes.template single_lobe_as<Lambert<Color>>() != nullptr;
    else
      return false;
  }
  // The largest number of edges of the path of a photon.
  int max_photon_length() const {
    return view_.max_length > 0 ? view_.max_length - edges_ : std::numeric_limits<int>::max();
  }

  Color value_by_letter(const Vec3& wi, const typename transport::JoinWeights<Color>::ByLetter& weight) const {
    Color f(0);
    if (bsdf_.has_component(ScatterType::diffuse))
      f = bsdf_.eval_component(ScatterType::diffuse, wo_, wi) * weight.diffuse;
    if (bsdf_.has_component(ScatterType::glossy) && view_.split.gloss_is_rough(bsdf_))
      f += bsdf_.eval_component(ScatterType::glossy, wo_, wi) * weight.glossy;
    return f;
  }

  struct Empty {};
  const SurfaceBsdf& bsdf_;
  const Vec3 &wo_, &ng_;
  const PhotonView& view_;
  int edges_;
  bool has_geometric_normal_, is_lambertian_;
  Color lambertian_value_{0};
  [[no_unique_address]] std::conditional_t<M::kClasses, transport::JoinWeights<Color>, Empty> weights_;
};

// The scattering of photons by the phase function of a vertex that is `edges` edges from the camera.
template <class M>
class PhotonScattering {
 public:
  using Color = typename M::Color;

  PhotonScattering(transport::PathWavefront<M>& paths, int hit, const PhotonView& view, int edges)
      : phase_(*paths.collision(hit).phase), wo_(paths.wo(hit)), view_(view), edges_(edges) {
    if constexpr (M::kClasses) transport::find_join_weights(paths.shares(), paths.path_at(hit), *view.join, weights_);
  }

  // p Phi / sigma_s
  Color scattered(const photon::Photon& photon) const {
    if (view_.max_length > 0 && edges_ + photon.length() > view_.max_length) return Color(0);
    const Color value = photon.power() * phase_.eval(wo_, photon.direction());
    if constexpr (M::kClasses)
      return value * weights_.by_state[photon.state()].volume;
    else
      return value;
  }

 private:
  struct Empty {};
  const PhaseFunction& phase_;
  const Vec3& wo_;
  const PhotonView& view_;
  int edges_;
  [[no_unique_address]] std::conditional_t<M::kClasses, transport::JoinWeights<Color>, Empty> weights_;
};

inline float ball_volume(float radius2) { return 4.0f / 3 * kPi * radius2 * std::sqrt(radius2); }

// The number of photons in an estimate, and their maximum squared distance.
struct NearestPhotons {
  size_t count = 2;
  float max_distance2 = kInfinity;
  photon::Kernel kernel = photon::Kernel::constant;
};

// Adds the light that the current surfaces reflect, with the nearest photons. `before` is the number of edges between the
// camera and the start of these paths.
template <class M, class Selected = transport::EveryHit>
void add_nearest_photons(transport::PathWavefront<M>& paths, const PhotonView& view, const NearestPhotons& nearest,
                         int before, const Selected& selected = {}) {
  static thread_local std::vector<photon::Neighbour> neighbours;
  const Stopwatch::Lap lap(view.watch);
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!selected(i) || paths.in_volume(i) || !view.split.has_rough(paths.bsdf(i))) continue;
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

// The same for the current collisions in media, except for shallow ones, which it finds (shallow_collisions.h).
template <class M, class Shallow>
void add_nearest_volume_photons(transport::PathWavefront<M>& paths, const PhotonView& view,
                                const NearestPhotons& nearest, int before, Shallow&& shallow) {
  if constexpr (M::kScattering) {
    if (!view.volume_map) return;
    static thread_local std::vector<photon::Neighbour> neighbours;
    const Stopwatch::Lap lap(view.watch);
    for (int i = 0; i < paths.hit_count(); ++i) {
      if (!paths.in_volume(i)) continue;
      // The decision must not depend on the photons: it would discard estimates that are too dark.
      if (shallow.decide(i, std::isfinite(nearest.max_distance2) ? nearest.max_distance2 : 0)) continue;
      const auto ball =
          view.volume_map->nearest_in_ball(paths.point(i).position, nearest.count, nearest.max_distance2, neighbours);
      if (ball.photons.empty()) continue;
      const PhotonScattering<M> scattering(paths, i, view, before + paths.length());
      typename M::Color sum(0);
      for (const photon::Neighbour& n : ball.photons)
        sum += scattering.scattered((*view.volume_map)[n.photon]) *
               kernel_weight(nearest.kernel, n.distance2 / ball.radius2, photon::Region::ball);
      auto& path = paths.state_at(i);
      path.radiance += path.throughput * sum / ball_volume(ball.radius2);
    }
  }
}

// Adds the light that the current surfaces reflect, with all photons within a radius: `radius2(i)` is the squared radius
// of hit i.
template <class M, class Radius2>
void add_photons_within(transport::PathWavefront<M>& paths, const PhotonView& view, const Radius2& radius2) {
  const Stopwatch::Lap lap(view.watch);
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (paths.in_volume(i) || !view.split.has_rough(paths.bsdf(i))) continue;
    const scene::SurfacePoint& point = paths.point(i);
    const PhotonReflection<M> reflection(paths, i, view, paths.length());
    const float r2 = radius2(i);
    typename M::Color sum(0);
    if (reflection.is_lambertian())
      sum = reflection.reflected_within(point.position, r2);
    else
      view.map->for_each_within(point.position, point.ng, r2,
                                [&](const photon::Photon& photon, float) { sum += reflection.reflected(photon); });
    auto& path = paths.state_at(i);
    path.radiance += path.throughput * sum / (kPi * r2);
  }
}

// The same for the current collisions in media, except for shallow ones, which it finds (shallow_collisions.h).
template <class M>
void add_volume_photons_within(transport::PathWavefront<M>& paths, const PhotonView& view, float radius2,
                               ShallowCollisions<M>& shallow) {
  if constexpr (M::kScattering) {
    if (!view.volume_map) return;
    const Stopwatch::Lap lap(view.watch);
    for (int i = 0; i < paths.hit_count(); ++i) {
      if (!paths.in_volume(i)) continue;
      if (shallow.decide(i, radius2)) continue;
      const PhotonScattering<M> scattering(paths, i, view, paths.length());
      typename M::Color sum(0);
      view.volume_map->for_each_in_ball(paths.point(i).position, radius2, [&](const photon::Photon& photon, float) {
        sum += scattering.scattered(photon);
      });
      auto& path = paths.state_at(i);
      path.radiance += path.throughput * sum / ball_volume(radius2);
    }
  }
}

}  // namespace etendue::integrator
