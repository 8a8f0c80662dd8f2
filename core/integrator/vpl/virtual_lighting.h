// What virtual lights do for the walks of a block.
#pragma once
#include "integrator/vpl/virtual_lights.h"
#include "transport/wavefront/connections.h"

namespace etendue::integrator {

// By what connections are weighed; both cosines are to the geometric normals.
inline float geometry_term(float cosine_a, float cosine_b, float distance2) {
  return std::abs(cosine_a * cosine_b) / distance2;
}
// The part of a connection that a bound keeps; 0 is no bound.
inline float kept_of(float geometry, float bound) { return bound > 0 && geometry > bound ? bound / geometry : 1; }

template <class M>
class VirtualLighting {
 public:
  using Color = typename M::Color;
  using PathWavefront = transport::PathWavefront<M>;

  struct Options {
    std::span<const VirtualLight> lights;
    bool lambertian = true;
    float bound = 0;
    int longest = 0;  // edges of a whole path; 0: no limit
    const transport::ClassJoin* join = nullptr;
  };

  // `subset_of(path)` is that of the virtual lights which a path is connected to.
  template <class SubsetOf>
  void begin(const Options& options, int paths, SubsetOf&& subset_of) {
    options_ = options, rays_traced_ = 0;
    for (int i = 0; i < paths; ++i) subsets_[static_cast<size_t>(i)] = subset_of(i);
  }
  uint64_t rays_traced() const { return rays_traced_; }

  // Adds what all arrivals get. Light by light: its rays to neighbouring pixels lie close together.
  void add(PathWavefront& paths) {
    find_weights(paths);
    for (const VirtualLight& light : options_.lights) {
      if (options_.longest > 0 && paths.length() + 1 + light.length > options_.longest) continue;
      if (!options_.lambertian) transport::build_bsdf<M>(light.point, bsdf_);
      for (int i = 0; i < paths.hit_count(); ++i) {
        const auto path = static_cast<size_t>(paths.path_at(i));
        if (subsets_[path] == light.subset && paths.bsdf(i).has_non_delta_lobe() &&
            !is_black(paths.state_at(i).throughput))
          connect(paths, i, light);
      }
    }
    settle(paths);
  }

 private:
  struct Gain {
    int path;
    Color radiance;
  };
  // The letters of a scattering function times its cosine.
  struct Letters {
    Color diffuse, glossy;
  };
  struct Nothing {};

  void settle(PathWavefront& paths) {
    rays_traced_ += connections_.settle(paths.scene(), [&](const Gain& gain, const Rgb& transmittance) {
      paths.state(gain.path).radiance += gain.radiance * transmittance;
    });
  }

  void connect(PathWavefront& paths, int i, const VirtualLight& light) {
    const scene::SurfacePoint& point = paths.point(i);
    const Vec3 apart = light.point.position - point.position;
    const float distance2 = glm::dot(apart, apart);
    if (!(distance2 > 0)) return;
    const float distance = std::sqrt(distance2);
    const Vec3 w = apart / distance;
    const float cosine = glm::dot(light.point.ng, w);
    const Color scattered = scattering(paths, i, light, w, cosine);
    if (is_black(scattered)) return;
    const float kept = kept_of(geometry_term(glm::dot(point.ng, w), cosine, distance2), options_.bound);
    auto& path = paths.state_at(i);
    Ray ray;
    point.spawn_segment(w, distance, ray);
    const auto number = static_cast<uint32_t>(&light - options_.lights.data());
    Gain& gain = connections_.add(ray, path.time, path_seed(path.seed, paths.sample()) + number,
                                  paths.medium_beyond(i, w), distance);
    gain.path = paths.path_at(i);
    gain.radiance = path.throughput * scattered * light.power * (kept / distance2);
    if (connections_.full()) settle(paths);
  }

  // f cos at both ends, without what classes leave out.
  Color scattering(PathWavefront& paths, int i, const VirtualLight& light, const Vec3& w, float cosine) {
    if constexpr (!M::kClasses) {
      const Color here = paths.bsdf(i).evaluate(paths.wo(i), w).f_cos;
      if (is_black(here)) return here;
      if (!options_.lambertian) return here * bsdf_.evaluate(light.wo, -w, TransportMode::importance).f_cos;
      return here * (std::max(0.0f, -cosine * light.side) * kInvPi);
    } else {
      const Letters here = letters(paths.bsdf(i), paths.wo(i), w, TransportMode::radiance);
      const auto joined = [&](transport::Automaton::State state) {
        const auto& weight = weights_[static_cast<size_t>(i)].of[state];
        return here.diffuse * weight.diffuse + here.glossy * weight.glossy;
      };
      if (options_.lambertian) return joined(light.state) * (std::max(0.0f, -cosine * light.side) * kInvPi);
      const Letters there = letters(bsdf_, light.wo, -w, TransportMode::importance);
      const transport::Automaton& reader = options_.join->light();
      return there.diffuse * joined(reader.next(light.state, transport::Event::diffuse)) +
             there.glossy * joined(reader.next(light.state, transport::Event::glossy));
    }
  }

  static Letters letters(const Bsdf<M>& bsdf, const Vec3& wo, const Vec3& wi, TransportMode mode) {
    const float cosine = bsdf.cosine(wi);
    Letters letters{Color(0), Color(0)};
    if (bsdf.has_component(ScatterType::diffuse))
      letters.diffuse = bsdf.eval_component(ScatterType::diffuse, wo, wi, mode) * cosine;
    if (bsdf.has_component(ScatterType::glossy))
      letters.glossy = bsdf.eval_component(ScatterType::glossy, wo, wi, mode) * cosine;
    return letters;
  }

  void find_weights(PathWavefront& paths) {
    if constexpr (M::kClasses)
      for (int i = 0; i < paths.hit_count(); ++i)
        transport::find_join_weights(paths.shares(), paths.path_at(i), *options_.join,
                                     weights_[static_cast<size_t>(i)]);
  }

  Options options_;
  uint64_t rays_traced_ = 0;
  Bsdf<M> bsdf_;  // of the light at hand
  std::array<uint32_t, PathWavefront::kCapacity> subsets_;
  transport::Connections<Gain> connections_;
  [[no_unique_address]] std::conditional_t<
      M::kClasses, std::array<transport::JoinWeights<Color>, PathWavefront::kHitsAtATime>, Nothing>
      weights_;
};

}  // namespace etendue::integrator
