// Chains of specular events from a point: a ray that mirrors and glass reflect and refract, with its derivatives.
//
// A chain is determined by the direction in which it begins and by its type, i.e. the side of the surface on which it
// continues at each vertex.
#pragma once
#include <array>
#include <optional>

#include "integrator/manifold/specular_casters.h"
#include "integrator/markov_chain/chain_random.h"
#include "transport/surface_bsdf.h"
#include "transport/wavefront/medium_tracing.h"
#include "transport/wavefront/path_media.h"

namespace etendue::integrator::manifold {

// The sequence of reflections and transmissions.
struct ChainType {
  static constexpr int kMaxLength = 8;

  int length = 0;
  uint32_t transmitted = 0;  // bit k: at vertex k

  void append(bool is_transmitted) { transmitted |= (is_transmitted ? 1U : 0U) << length++; }
  bool operator==(const ChainType&) const = default;
};

// Where chains begin.
template <class M>
struct ChainStart {
  scene::SurfacePoint point;
  Vec3 wo;  // the direction from which the point is seen
  float time = 0;
  uint32_t seed = 0;                               // of stochastic opacity
  int max_length = 0;                              // of chains
  std::array<transport::MediumState<M>, 2> media;  // on the back and on the front of the surface
};

// A specular event at a caster, of a ray in this direction whose last vertex is at this distance.
inline void scatter_derivatives(const scene::SurfacePoint& point, const Vec3& direction, float distance,
                                bool transmitted, float eta, RayDerivatives& derivatives) {
  derivatives.transfer(direction, distance, point.ng);
  if (transmitted)
    derivatives.refract(direction, eta, curved_surface(point));
  else
    derivatives.reflect(direction, curved_surface(point));
}

// A chain up to its last vertex.
template <class M>
struct Chain {
  using Color = typename M::Color;

  Frame start;  // z is the direction at the start
  ChainType type;
  Color throughput{1};    // coefficients of the events and transmittances, without the last segment
  float probability = 1;  // that BSDF samples select these events
  scene::SurfacePoint last;
  Vec3 direction;                                          // in which it leaves the last vertex
  RayDerivatives derivatives;                              // there, by the axes x and y of `start`
  [[no_unique_address]] transport::MediumState<M> medium;  // beyond the last vertex
};

template <class M>
class ChainTracer {
 public:
  using Color = typename M::Color;

  ChainTracer(const scene::CompiledScene& scene, const ChainStart<M>& start) : scene_(scene), start_(start) {}

  const ChainStart<M>& start() const { return start_; }
  uint64_t rays() const { return rays_; }

  // The chain of a given type in a direction; false if there is none.
  bool trace(const Vec3& direction, const ChainType& type, Chain<M>& chain) {
    begin(direction, chain);
    for (int k = 0; k < type.length; ++k) {
      Vertex x;
      if (!next_vertex(chain, x)) return false;
      const bool transmitted = (type.transmitted >> k & 1) != 0;
      DeltaDirection<Color> event;
      if (!x.bsdf.delta_direction(x.wo, transmitted, TransportMode::radiance, event)) return false;
      scatter(x, transmitted, event, chain);
    }
    return true;
  }

  // A chain of a random type in a direction, to reach a point; false if there is none.
  bool trace_any(const Vec3& direction, const std::optional<Vec3>& end, ChainRandom& random, Chain<M>& chain) {
    // The probability that a chain ends before the next caster, if that is closer than the point and if it is not.
    constexpr float kStopAtFarPoint = 0.05f, kStopAtNearPoint = 0.5f;
    begin(direction, chain);
    while (chain.type.length < start_.max_length) {
      Vertex x;
      if (!next_vertex(chain, x)) break;
      const bool is_near = end && glm::distance(chain.last.position, *end) < x.distance;
      if (chain.type.length > 0 && random.next() < (is_near ? kStopAtNearPoint : kStopAtFarPoint)) break;
      DeltaDirection<Color> reflection, transmission;
      const bool reflects = x.bsdf.delta_direction(x.wo, false, TransportMode::radiance, reflection);
      const bool transmits = x.bsdf.delta_direction(x.wo, true, TransportMode::radiance, transmission);
      if (!reflects && !transmits) break;
      const float share = transmission.probability / (reflection.probability + transmission.probability);
      const bool transmitted = transmits && (!reflects || random.next() < std::clamp(share, 0.1f, 0.9f));
      scatter(x, transmitted, transmitted ? transmission : reflection, chain);
    }
    return chain.type.length > 0;
  }

  // The transmittance from the last vertex to a point at this distance in this direction, 0 if a surface blocks it. The
  // direction is nearly that in which the chain leaves.
  Color transmittance_to_end(const Chain<M>& chain, const Vec3& direction, float distance) {
    Ray ray;
    chain.last.spawn_segment(direction, distance, ray);
    const uint32_t seed = start_.seed + static_cast<uint32_t>(chain.type.length) + 1;
    if constexpr (M::kMedia) {
      return transport::connection_passage(scene_, ray, distance, seed, start_.time, chain.medium, rays_).transmittance;
    } else {
      ++rays_;
      return scene_.intersect(ray, seed, start_.time) ? Color(0) : Color(1);
    }
  }

 private:
  struct Vertex {
    Hit hit;
    scene::SurfacePoint point;
    Bsdf<M> bsdf;
    Vec3 wo;
    float distance;
    Color transmittance{1};
    [[no_unique_address]] std::conditional_t<M::kMedia, scene::MediumInterface, transport::Vacuum> interface;
  };

  void begin(const Vec3& direction, Chain<M>& chain) {
    chain.start.build(direction);
    chain.type = {};
    chain.throughput = Color(1);
    chain.probability = 1;
    chain.last = start_.point;
    chain.direction = direction;
    chain.derivatives = RayDerivatives::around(chain.start);
    chain.medium = start_.media[glm::dot(start_.point.ng, direction) >= 0 ? 1 : 0];
  }

  // The next vertex; false if the chain hits none that is a caster.
  bool next_vertex(const Chain<M>& chain, Vertex& x) {
    Ray ray;
    chain.last.spawn(chain.direction, ray);
    const uint32_t seed = start_.seed + static_cast<uint32_t>(chain.type.length);
    if constexpr (M::kMedia) {
      transport::MediumSegment segment;
      transport::trace_segment(scene_, ray, ray.tfar, seed, start_.time, chain.medium, segment);
      rays_ += 1 + segment.rays;
      x.hit = segment.hit;
      x.transmittance = segment.transmittance;
      x.interface = segment.interface;
    } else {
      ++rays_;
      x.hit = scene_.intersect(ray, seed, start_.time);
    }
    if (!x.hit) return false;
    x.wo = -chain.direction;
    scene_.surfaces({&x.wo, 1}, {&x.hit, 1}, &x.point);
    if (!is_caster(x.point, x.wo)) return false;
    if constexpr (M::kMedia) {
      x.point.outside = scene_.solids().find(x.interface.top(true));
      x.point.inside = scene_.solids().find(x.interface.top(false));
      x.point.offset = std::max(x.point.offset, x.interface.offset);
    }
    transport::build_bsdf<M>(x.point, x.bsdf);
    x.distance = glm::distance(chain.last.position, x.point.position);
    return x.distance > 0;
  }

  void scatter(const Vertex& x, bool transmitted, const DeltaDirection<Color>& event, Chain<M>& chain) {
    scatter_derivatives(x.point, chain.direction, x.distance, transmitted, event.eta, chain.derivatives);
    chain.throughput *= x.transmittance * event.value;
    chain.probability *= event.probability;
    chain.last = x.point;
    chain.direction = event.wi;
    if constexpr (M::kMedia) chain.medium = x.interface.side(glm::dot(x.point.ng, event.wi) >= 0);
    chain.type.append(transmitted);
  }

  const scene::CompiledScene& scene_;
  const ChainStart<M>& start_;
  uint64_t rays_ = 0;
};

}  // namespace etendue::integrator::manifold
