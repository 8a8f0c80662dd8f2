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
    is_lambertian_ = !M::kClasses && has_geometric_normal_ && transport::is_lambertian<typename M::Surfaces>(bsdf_);
    if (is_lambertian_) lambertian_value_ = bsdf_.eval(wo_, wo_);
    if constexpr (M::kClasses) transport::find_join_weights(paths.shares(), paths.path_at(hit), *view.join, weights_);
  }

  // The sum of f Phi times the kernel, over all photons of a region.
  Color reflected(const photon::Neighbourhood& found, photon::Kernel kernel) const {
    if (is_lambertian_ && kernel == photon::Kernel::constant && found.is_open())
      return lambertian_value_ * view_.map->sum_of_powers(found, lambertian_side());
    Color sum(0);
    view_.map->for_each(found, [&](const photon::Photon& photon, float distance2) {
      sum += reflected(photon) * kernel_weight(kernel, distance2 / found.radius2());
    });
    return sum;
  }

 private:
  using SurfaceBsdf = Bsdf<typename M::Surfaces>;

  static const SurfaceBsdf& surface_of(const Bsdf<M>& bsdf) {
    if constexpr (M::kScattering)
      return bsdf.surface();
    else
      return bsdf;
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

  photon::LambertianSide lambertian_side() const {
    const int max_length = view_.max_length > 0 ? view_.max_length - edges_ : std::numeric_limits<int>::max();
    return {.normal = ng_, .side = glm::dot(ng_, wo_), .max_length = max_length};
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
  bool has_geometric_normal_;
  // f is constant for all directions that are reflected, which is its value for the view direction.
  bool is_lambertian_;
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
  static thread_local photon::Neighbourhood found;
  const Stopwatch::Lap lap(view.watch);
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!selected(i) || paths.in_volume(i) || !view.split.has_rough(paths.bsdf(i))) continue;
    const scene::SurfacePoint& point = paths.point(i);
    view.map->find_nearest(point.position, point.ng, nearest.count, nearest.max_distance2, found);
    if (found.empty()) continue;
    const PhotonReflection<M> reflection(paths, i, view, before + paths.length());
    auto& path = paths.state_at(i);
    path.radiance += path.throughput * reflection.reflected(found, nearest.kernel) / (kPi * found.radius2());
  }
}

// The same for the current collisions in media, except for shallow ones, which it finds (shallow_collisions.h).
template <class M, class Shallow>
void add_nearest_volume_photons(transport::PathWavefront<M>& paths, const PhotonView& view,
                                const NearestPhotons& nearest, int before, Shallow&& shallow) {
  if constexpr (M::kScattering) {
    if (!view.volume_map) return;
    static thread_local photon::Neighbourhood found;
    const Stopwatch::Lap lap(view.watch);
    for (int i = 0; i < paths.hit_count(); ++i) {
      if (!paths.in_volume(i)) continue;
      // The decision must not depend on the photons: it would discard estimates that are too dark.
      if (shallow.decide(i, std::isfinite(nearest.max_distance2) ? nearest.max_distance2 : 0)) continue;
      view.volume_map->find_nearest_in_ball(paths.point(i).position, nearest.count, nearest.max_distance2, found);
      if (found.empty()) continue;
      const PhotonScattering<M> scattering(paths, i, view, before + paths.length());
      typename M::Color sum(0);
      view.volume_map->for_each(found, [&](const photon::Photon& photon, float distance2) {
        sum += scattering.scattered(photon) *
               kernel_weight(nearest.kernel, distance2 / found.radius2(), photon::Region::ball);
      });
      auto& path = paths.state_at(i);
      path.radiance += path.throughput * sum / ball_volume(found.radius2());
    }
  }
}

// Lookups within a radius for the current surfaces. Up to sixteen consecutive hits share the search of the tree if they are
// close to each other, as those of neighbouring pixels are.
template <class M>
class GroupedLookups {
 public:
  static constexpr int kSize = 16;

  // The hits from `first` on for which `is_looked_up(hit)` is true; `radius2(hit)` is the squared radius.
  template <class IsLookedUp, class Radius2>
  GroupedLookups(transport::PathWavefront<M>& paths, const photon::PhotonMap& map, int first,
                 const IsLookedUp& is_looked_up, const Radius2& radius2)
      : paths_(paths), map_(map) {
    Bounds box;
    float largest2 = 0;
    for (int i = first; i < std::min(first + kSize, paths.hit_count()); ++i) {
      if (!is_looked_up(i)) continue;
      hits_[count_] = i;
      radii2_[count_] = radius2(i);
      largest2 = std::max(largest2, radii2_[count_++]);
      box.extend(paths.point(i).position);
    }
    const Vec3 size = box.max - box.min;
    is_close_ = count_ > 1 && glm::dot(size, size) < kMaxSize2 * largest2;
    if (is_close_) map.find_leaves(box, largest2, leaves());
  }

  // Calls look_up(hit, found, radius2).
  template <class LookUp>
  void for_each(const LookUp& look_up) const {
    static thread_local photon::Neighbourhood found;
    for (size_t k = 0; k < count_; ++k) {
      const scene::SurfacePoint& point = paths_.point(hits_[k]);
      if (is_close_)
        map_.find_within(leaves(), point.position, point.ng, radii2_[k], found);
      else
        map_.find_within(point.position, point.ng, radii2_[k], found);
      look_up(hits_[k], found, radii2_[k]);
    }
  }

 private:
  // Of the box of the group, relative to the largest radius: a larger box would have too many leaves.
  static constexpr float kMaxSize2 = sqr(8.0f);

  static photon::LeafGroup& leaves() {
    static thread_local photon::LeafGroup group;
    return group;
  }

  transport::PathWavefront<M>& paths_;
  const photon::PhotonMap& map_;
  std::array<int, kSize> hits_{};
  std::array<float, kSize> radii2_{};
  size_t count_ = 0;
  bool is_close_ = false;
};

// Adds the light that the current surfaces reflect, with all photons within a radius: `radius2(i)` is the squared radius
// of hit i.
template <class M, class Radius2>
void add_photons_within(transport::PathWavefront<M>& paths, const PhotonView& view, const Radius2& radius2) {
  const Stopwatch::Lap lap(view.watch);
  const auto is_looked_up = [&](int i) { return !paths.in_volume(i) && view.split.has_rough(paths.bsdf(i)); };
  for (int first = 0; first < paths.hit_count(); first += GroupedLookups<M>::kSize) {
    const GroupedLookups<M> lookups(paths, *view.map, first, is_looked_up, radius2);
    lookups.for_each([&](int i, const photon::Neighbourhood& found, float r2) {
      if (found.empty()) return;
      const PhotonReflection<M> reflection(paths, i, view, paths.length());
      auto& path = paths.state_at(i);
      path.radiance += path.throughput * reflection.reflected(found, photon::Kernel::constant) / (kPi * r2);
    });
  }
}

// The same for the current collisions in media, except for shallow ones, which it finds (shallow_collisions.h).
template <class M>
void add_volume_photons_within(transport::PathWavefront<M>& paths, const PhotonView& view, float radius2,
                               ShallowCollisions<M>& shallow) {
  if constexpr (M::kScattering) {
    if (!view.volume_map) return;
    static thread_local photon::Neighbourhood found;
    const Stopwatch::Lap lap(view.watch);
    for (int i = 0; i < paths.hit_count(); ++i) {
      if (!paths.in_volume(i)) continue;
      if (shallow.decide(i, radius2)) continue;
      const PhotonScattering<M> scattering(paths, i, view, paths.length());
      typename M::Color sum(0);
      view.volume_map->find_within_ball(paths.point(i).position, radius2, found);
      view.volume_map->for_each(found,
                                [&](const photon::Photon& photon, float) { sum += scattering.scattered(photon); });
      auto& path = paths.state_at(i);
      path.radiance += path.throughput * sum / ball_volume(radius2);
    }
  }
}

}  // namespace etendue::integrator
