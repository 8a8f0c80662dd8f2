// The media of the paths of a wavefront, stored separately from PathState. Empty in models without media.
//
// In models with scattering media, a segment can end at a collision instead of a surface.
#pragma once
#include <array>

#include "sampling/sampler.h"
#include "transport/model_types.h"
#include "transport/wavefront/medium_tracing.h"
#include "transport/wavefront/path_color.h"

namespace etendue::transport {

// The medium state of a path in models without media.
struct Vacuum {};

template <class M>
using MediumState = std::conditional_t<M::kMedia, scene::MediumStack, Vacuum>;

template <class M, bool media = M::kMedia>
class PathMedia;

template <class M>
class PathMedia<M, false> {};

template <class M>
class PathMedia<M, true> {
 public:
  using Color = typename M::Color;
  using MediumStack = scene::MediumStack;

  void begin(const scene::CompiledScene& scene, const PathColor<M>& color) {
    scene_ = &scene;
    color_ = &color;
  }

  // The solids and the ray at the start of the current segment of a path.
  MediumStack& stack(int path) { return stacks_[static_cast<size_t>(path)]; }
  void set_ray(int path, const Ray& ray) { rays_[static_cast<size_t>(path)] = ray; }

  // The same in a model with scattering media, with a uniform random number for the distance to a collision. Returns
  // whether the segment ends on a surface or at a collision.
  bool sample_segment(int path, int slot, uint32_t seed, float time, float random, Hit& hit, Color& throughput,
                      uint64_t& traced) {
    const auto p = static_cast<size_t>(path);
    FlightSegment segment;
    segment.hit = hit;
    transport::sample_segment(*scene_, rays_[p], rays_[p].tfar, seed, time, stacks_[p], FreeFlight(throughput, random),
                              segment);
    throughput *= segment.transmittance;
    traced += segment.rays;
    hit = segment.hit;
    interfaces_[static_cast<size_t>(slot)] = segment.interface;
    collisions_.at(slot) = segment.collision;
    return hit || segment.collision.phase;
  }
  // The collision at which vertex `slot` lies; without a phase function if it lies on a surface.
  const Collision& collision(int slot) { return collisions_.at(slot); }

  // Completes the segment of a path that was traced to `hit`, which may be empty, and attenuates its throughput.
  // Returns whether it ends on a surface, vertex `slot`. Adds the number of further rays to `traced`.
  bool complete_segment(int path, int slot, uint32_t seed, float time, Hit& hit, Color& throughput, uint64_t& traced) {
    const auto p = static_cast<size_t>(path);
    scene::MediumInterface& interface = interfaces_[static_cast<size_t>(slot)];
    unattenuated_[p] = throughput;
    if (stacks_[p].empty() && (!hit || scene_->instances()[hit.instance].solid == scene::kNoSolid)) {
      interface.clear(stacks_[p]);
      return bool{hit};
    }
    MediumSegment segment;
    segment.hit = hit;
    transport::complete_segment(*scene_, rays_[p], rays_[p].tfar, seed, time, stacks_[p], segment);
    throughput *= color_->transmittance(path, segment.transmittance);
    traced += segment.rays;
    hit = segment.hit;
    if (hit) interface = segment.interface;
    return bool{hit};
  }

  // Sets the media on both sides of a vertex, and the offset that clears all coincident boundaries.
  void set_media(int slot, scene::SurfacePoint& point) const {
    const scene::MediumInterface& at = interfaces_[static_cast<size_t>(slot)];
    point.outside = scene_->solids().find(at.top(true));
    point.inside = scene_->solids().find(at.top(false));
    point.offset = std::max(point.offset, at.offset);
  }
  // The solids at the start of a ray that leaves the vertex in this direction.
  MediumStack medium_beyond(int slot, const scene::SurfacePoint& point, const Vec3& direction) const {
    return interfaces_[static_cast<size_t>(slot)].side(glm::dot(point.ng, direction) >= 0);
  }

  // The throughput on the current segment at a distance from its start, metres.
  Color throughput_after(int path, float distance, uint32_t seed, float time) const {
    const auto p = static_cast<size_t>(path);
    Ray ray = rays_[p];
    ray.tfar = distance;
    uint64_t rays = 0;
    return unattenuated_[p] * color_->transmittance(path, TracedConnections(*scene_).transmittance(
                                                              false, ray, distance, seed, time, stacks_[p], rays));
  }

  // Stores a connection; `length` is the distance of its end, metres.
  void connect(size_t slot, const Ray& ray, float length, const MediumStack& stack) {
    connections_[slot].ray = ray;
    connections_[slot].length = length;
    connections_[slot].stack = stack;
  }
  Rgb transmittance(size_t slot, bool blocked, uint32_t seed, float time, uint64_t& traced) const {
    const Connection& c = connections_[slot];
    return TracedConnections(*scene_).transmittance(blocked, c.ray, c.length, seed, time, c.stack, traced);
  }

 private:
  struct Connection {
    Ray ray;
    float length;
    MediumStack stack;
  };
  template <class T>
  using PerPath = std::array<T, SampleTable::kPaths>;

  const scene::CompiledScene* scene_ = nullptr;
  const PathColor<M>* color_ = nullptr;
  // By path.
  PerPath<MediumStack> stacks_;
  PerPath<Ray> rays_;
  PerPath<Color> unattenuated_;  // throughput at the start of the segment
  // By vertex reached.
  PerPath<scene::MediumInterface> interfaces_;
  struct Collisions {
    Collision& at(int slot) { return values[static_cast<size_t>(slot)]; }
    PerPath<Collision> values;
  };
  struct NoCollisions {};
  [[no_unique_address]] std::conditional_t<M::kScattering, Collisions, NoCollisions> collisions_;
  // By connection.
  PerPath<Connection> connections_;
};

}  // namespace etendue::transport
