// Collisions of camera paths near the boundary of a medium.
//
// A ball around such a collision lies partly outside of the medium, where no photons are stored, and would be too dark.
// Camera paths continue from there as in path tracing, until the point where they entered the medium and, in homogeneous
// media, the next boundary or surface in their direction are farther away than the largest radius of a lookup. Collisions
// close to other parts of the boundary remain too dark; this error vanishes with the radius.
#pragma once
#include "transport/wavefront/lobe_split.h"

namespace etendue::integrator {

template <class M>
class ShallowCollisions {
 public:
  using PathWavefront = transport::PathWavefront<M>;

  explicit ShallowCollisions(PathWavefront& paths) : paths_(paths) {}

  // Updates the points of entry. To be called for every batch of hits.
  void begin_hits() {
    if constexpr (M::kScattering)
      for (int i = 0; i < paths_.hit_count(); ++i) {
        const auto path = static_cast<size_t>(paths_.path_at(i));
        data_.is_shallow[static_cast<size_t>(i)] = false;
        if (paths_.in_volume(i) && !data_.is_inside[path]) data_.entry[path] = point_of_entry(paths_.path_at(i));
        data_.is_inside[path] = paths_.in_volume(i);
      }
  }
  // Decides whether a current collision is shallow for a lookup with this squared radius.
  bool decide(int hit, float radius2) {
    if constexpr (M::kScattering) {
      const Vec3 d = paths_.point(hit).position - data_.entry[static_cast<size_t>(paths_.path_at(hit))];
      return data_.is_shallow[static_cast<size_t>(hit)] =
                 glm::dot(d, d) < radius2 || sqr(distance_to_exit(hit)) < radius2;
    }
    return false;
  }
  // The decision; false on surfaces.
  bool operator()(int hit) const {
    if constexpr (M::kScattering)
      return data_.is_shallow[static_cast<size_t>(hit)];
    else
      return false;
  }

 private:
  // Where the segment that ends at the first collision of a path enters the medium.
  Vec3 point_of_entry(int path) const {
    const transport::ScatteringInterval& part = paths_.media().first_interval(path);
    const Ray& ray = paths_.media().ray(path);
    return part.medium ? ray.origin + glm::normalize(ray.direction) * part.from : paths_.state(path).from;
  }

  // The distance from a collision to the end of the medium in the direction of the path, if it is known.
  float distance_to_exit(int hit) const {
    const int path = paths_.path_at(hit);
    const transport::ScatteringInterval& part = paths_.media().first_interval(path);
    const float distance = glm::distance(paths_.media().ray(path).origin, paths_.point(hit).position);
    return part.contains(distance) ? part.to - distance : kInfinity;
  }

  struct Data {
    std::array<Vec3, PathWavefront::kCapacity> entry;  // by path
    std::array<bool, PathWavefront::kCapacity> is_inside{};
    std::array<bool, PathWavefront::kHitsAtATime> is_shallow{};  // by hit
  };
  struct NoData {};
  PathWavefront& paths_;
  [[no_unique_address]] std::conditional_t<M::kScattering, Data, NoData> data_;
};

// No collision is shallow.
struct NeverShallow {
  static bool decide(int, float) { return false; }
};

// Filter of BSDF samples (AcceptAll): continues paths by near-specular lobes, and from shallow collisions.
template <class M>
struct AcceptNearSpecularOrShallow {
  transport::AcceptNearSpecular near_specular;
  const ShallowCollisions<M>& shallow;

  bool operator()(transport::PathWavefront<M>& paths, int hit, LobeSample<typename M::Color>& s) const {
    return shallow(hit) ? transport::AcceptAll()(paths, hit, s) : near_specular(paths, hit, s);
  }
};

// Continues camera paths by near-specular lobes, and from shallow collisions. A recorder also receives the samples of
// all other paths.
template <class M>
void continue_near_specular(transport::PathWavefront<M>& paths, const transport::LobeSplit& split,
                            const ShallowCollisions<M>& shallow, int roulette_start) {
  const auto continues = [&](int i) {
    return shallow(i) || split.may_have_near_specular<M>(paths.bsdf(i)) || paths.recorder() != nullptr;
  };
  int first = 0;
  while (first < paths.hit_count() && !continues(first)) ++first;
  if (first == paths.hit_count()) return;
  transport::sample_bsdf_where(
      paths, roulette_start, TransportMode::radiance, continues, [](int, const auto&) {},
      AcceptNearSpecularOrShallow<M>{{split}, shallow});
}

}  // namespace etendue::integrator
