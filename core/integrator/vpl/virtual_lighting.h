// Illumination of a block of camera paths by virtual lights.
#pragma once
#include "integrator/vpl/virtual_lights.h"
#include "transport/wavefront/connections.h"

namespace etendue::integrator {

// The geometry term of a connection; both cosines are to the geometric normals, or 1 in media.
inline float geometry_term(float cosine_a, float cosine_b, float distance2) {
  return std::abs(cosine_a * cosine_b) / distance2;
}
// The fraction of a connection that remains if the geometry term is clamped to `bound`; 0: no bound.
inline float bounded_fraction(float geometry, float bound) {
  return bound > 0 && geometry > bound ? bound / geometry : 1;
}

// The cosine of a direction from a current hit to the geometric normal; 1 in media.
template <class M>
float geometric_cosine(const transport::PathWavefront<M>& paths, int hit, const Vec3& w) {
  return paths.in_volume(hit) ? 1 : glm::dot(paths.point(hit).ng, w);
}

template <class M>
class VirtualLighting {
 public:
  using Color = typename M::Color;
  using PathWavefront = transport::PathWavefront<M>;

  struct Options {
    std::span<const VirtualLight> lights;
    bool lambertian = true;
    float bound = 0;
    int max_length = 0;  // edges of a whole path; 0: no limit
    const transport::ClassJoin* join = nullptr;
  };

  // `subset_of(path)` is the subset of virtual lights that a path is connected to.
  template <class SubsetOf>
  void begin(const Options& options, int paths, SubsetOf&& subset_of) {
    options_ = options;
    rays_traced_ = 0;
    for (int i = 0; i < paths; ++i) subsets_[static_cast<size_t>(i)] = subset_of(i);
  }
  uint64_t rays_traced() const { return rays_traced_; }

  // Adds the illumination of all current hits. The outer loop is over lights, because rays from neighbouring pixels to
  // one light are coherent.
  void add(PathWavefront& paths) {
    find_join_weights_of_hits(paths);
    for (const VirtualLight& light : options_.lights) {
      if (options_.max_length > 0 && paths.length() + 1 + light.length > options_.max_length) continue;
      if (!options_.lambertian && !light.phase) transport::build_bsdf<M>(light.point, bsdf_);
      for (int i = 0; i < paths.hit_count(); ++i) {
        const auto path = static_cast<size_t>(paths.path_at(i));
        if (subsets_[path] == light.subset && paths.bsdf(i).has_non_delta_lobe() &&
            !is_black(paths.state_at(i).throughput))
          connect(paths, i, light);
      }
    }
    trace_connections(paths);
  }

 private:
  struct Contribution {
    int path;
    Color radiance;
  };
  // The components of f |cos| by path letter.
  struct ByLetter {
    Color diffuse, glossy, volume{0};
  };
  struct Empty {};

  void trace_connections(PathWavefront& paths) {
    rays_traced_ += connections_.settle(paths.scene(), [&](const Contribution& contribution, const Rgb& transmittance) {
      paths.state(contribution.path).radiance += contribution.radiance * transmittance;
    });
  }

  void connect(PathWavefront& paths, int i, const VirtualLight& light) {
    const scene::SurfacePoint& point = paths.point(i);
    const Vec3 offset = light.point.position - point.position;
    const float distance2 = glm::dot(offset, offset);
    if (!(distance2 > 0)) return;
    const float distance = std::sqrt(distance2);
    const Vec3 w = offset / distance;
    const float cosine = light.cosine(w);
    const Color scattered = scattering(paths, i, light, w, cosine);
    if (is_black(scattered)) return;
    const float fraction =
        bounded_fraction(geometry_term(geometric_cosine(paths, i, w), cosine, distance2), options_.bound);
    auto& path = paths.state_at(i);
    Ray ray;
    point.spawn_segment(w, distance, ray);
    const auto number = static_cast<uint32_t>(&light - options_.lights.data());
    Contribution& contribution = connections_.add(ray, path.time, path_seed(path.seed, paths.sample()) + number,
                                                  paths.medium_beyond(i, w), distance);
    contribution.path = paths.path_at(i);
    contribution.radiance = path.throughput * scattered * light.power * (fraction / distance2);
    if (connections_.full()) trace_connections(paths);
  }

  // f |cos| at both ends, restricted to the selected path classes.
  Color scattering(PathWavefront& paths, int i, const VirtualLight& light, const Vec3& w, float cosine) {
    if constexpr (!M::kClasses) {
      const Color at_point = paths.bsdf(i).evaluate(paths.wo(i), w).f_cos;
      if (is_black(at_point)) return at_point;
      if (M::kScattering && light.phase) return at_point * light.phase->eval(light.wo, -w);
      if (!options_.lambertian) return at_point * bsdf_.evaluate(light.wo, -w, TransportMode::importance).f_cos;
      return at_point * (std::max(0.0f, -cosine * light.side) * kInvPi);
    } else {
      const ByLetter at_point = by_letter(paths.bsdf(i), paths.wo(i), w, TransportMode::radiance);
      const auto join = [&](transport::Automaton::State state) {
        const auto& weight = weights_[static_cast<size_t>(i)].by_state[state];
        return at_point.diffuse * weight.diffuse + at_point.glossy * weight.glossy + at_point.volume * weight.volume;
      };
      const transport::Automaton& automaton = options_.join->light();
      if (M::kScattering && light.phase) {
        const auto after = options_.lambertian ? light.state : automaton.next(light.state, transport::Event::volume);
        return join(after) * light.phase->eval(light.wo, -w);
      }
      if (options_.lambertian) return join(light.state) * (std::max(0.0f, -cosine * light.side) * kInvPi);
      const ByLetter at_light = by_letter(bsdf_, light.wo, -w, TransportMode::importance);
      return at_light.diffuse * join(automaton.next(light.state, transport::Event::diffuse)) +
             at_light.glossy * join(automaton.next(light.state, transport::Event::glossy));
    }
  }

  static ByLetter by_letter(const Bsdf<M>& bsdf, const Vec3& wo, const Vec3& wi, TransportMode mode) {
    ByLetter by_letter{Color(0), Color(0)};
    if constexpr (M::kScattering)
      if (bsdf.in_volume()) {
        by_letter.volume = bsdf.eval_component(ScatterType::volume, wo, wi, mode);
        return by_letter;
      }
    const float cosine = bsdf.cosine(wi);
    if (bsdf.has_component(ScatterType::diffuse))
      by_letter.diffuse = bsdf.eval_component(ScatterType::diffuse, wo, wi, mode) * cosine;
    if (bsdf.has_component(ScatterType::glossy))
      by_letter.glossy = bsdf.eval_component(ScatterType::glossy, wo, wi, mode) * cosine;
    return by_letter;
  }

  void find_join_weights_of_hits(PathWavefront& paths) {
    if constexpr (M::kClasses)
      for (int i = 0; i < paths.hit_count(); ++i)
        transport::find_join_weights(paths.shares(), paths.path_at(i), *options_.join,
                                     weights_[static_cast<size_t>(i)]);
  }

  Options options_;
  uint64_t rays_traced_ = 0;
  Bsdf<M> bsdf_;  // of the current light
  std::array<uint32_t, PathWavefront::kCapacity> subsets_;
  transport::Connections<Contribution> connections_;
  [[no_unique_address]] std::conditional_t<
      M::kClasses, std::array<transport::JoinWeights<Color>, PathWavefront::kHitsAtATime>, Empty>
      weights_;
};

}  // namespace etendue::integrator
