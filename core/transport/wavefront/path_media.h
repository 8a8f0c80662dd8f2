// The media of the paths of a wavefront, stored separately from PathState. Empty in models without media.
//
// In models with scattering media, a segment can end at a collision instead of a surface.
#pragma once
#include <algorithm>
#include <array>
#include <span>

#include "sampling/sampler.h"
#include "transport/mis/mis.h"
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
  const MediumStack& stack(int path) const { return stacks_[static_cast<size_t>(path)]; }
  void set_ray(int path, const Ray& ray) { rays_[static_cast<size_t>(path)] = ray; }

  // Paths choose a colour channel for every flight, keep one of them, or have no collisions (FreeFlight).
  void choose_channels(int path) requires(M::kScattering) { flights_.channel[static_cast<size_t>(path)] = -1; }
  void keep_channel(int path, int channel) requires(M::kScattering) {
    flights_.channel[static_cast<size_t>(path)] = static_cast<int8_t>(channel);
    flights_.next_densities[static_cast<size_t>(path)] = Color(1.0f / kChannels<Color>);
  }
  // Ends all channels of a path but the first. Returns one over the share of the first channel in the density of the
  // path.
  float keep_first_channel(int path) requires(M::kScattering) {
    const auto p = static_cast<size_t>(path);
    if (flights_.channel[p] < 0) return static_cast<float>(kChannels<Color>);
    const float share = flights_.next_densities[p][0];
    flights_.next_densities[p] = Color(0);
    flights_.next_densities[p][0] = 1;
    return share > 0 ? 1 / share : 0;
  }
  // Of the first `count` paths.
  void ignore_collisions(int count, bool ignore) requires(M::kScattering) {
    std::fill_n(flights_.channel.begin(), count, ignore ? kNoCollisions : int8_t{-1});
  }
  // A flight from the start of the current segment of a path.
  BasicFreeFlight<Color> flight(int path, float random) const requires(M::kScattering) {
    using Flight = BasicFreeFlight<Color>;
    const auto p = static_cast<size_t>(path);
    const int channel = flights_.channel[p];
    if (channel == kNoCollisions) return Flight::without_collision(unattenuated_[p]);
    return channel < 0 ? Flight(unattenuated_[p], random) : Flight(flights_.densities[p], channel, random);
  }

  // The same in a model with scattering media, with a uniform random number for the distance to a collision. Returns
  // whether the segment ends on a surface or at a collision.
  bool sample_segment(int path, int slot, uint32_t seed, float time, float random, Hit& hit, Color& throughput,
                      uint64_t& traced) {
    const auto p = static_cast<size_t>(path);
    unattenuated_[p] = throughput;
    flights_.densities[p] = flights_.next_densities[p];
    if (is_in_vacuum(p, hit)) {
      interfaces_[static_cast<size_t>(slot)].clear(stacks_[p]);
      flights_.survival[p] = 1;
      flights_.emitted[p] = Color(0);
      flights_.first[p].medium = nullptr;
      collisions_.at(slot).phase = nullptr;
      return bool{hit};
    }
    BasicFlightSegment<Color> segment;
    segment.hit = hit;
    transport::sample_segment(*scene_, rays_[p], rays_[p].tfar, seed, time, stacks_[p], flight(path, random), segment,
                              color_->media(path));
    flights_.next_densities[p] = segment.densities;
    throughput *= segment.transmittance;
    flights_.emitted[p] = segment.emitted;
    flights_.survival[p] = segment.survival_to_end;
    flights_.first[p] = segment.first;
    traced += segment.rays;
    hit = segment.hit;
    interfaces_[static_cast<size_t>(slot)] = segment.interface;
    collisions_.at(slot) = segment.collision;
    return hit || segment.collision.phase;
  }
  // The collision at which vertex `slot` lies; without a phase function if it lies on a surface.
  const Collision& collision(int slot) const { return collisions_.at(slot); }
  std::span<const Collision> collisions(int first_slot, size_t count) const {
    return {&collisions_.at(first_slot), count};
  }

  // Of the segment of a path that `sample_segment` completed: the radiance that media on it emit towards its start, the
  // probability that a flight passes it (FreeFlight::survival), its first part in a scattering medium, its ray, and the
  // throughput at its start.
  const Color& emitted(int path) const { return flights_.emitted[static_cast<size_t>(path)]; }
  float survival(int path) const { return flights_.survival[static_cast<size_t>(path)]; }
  const BasicScatteringInterval<Color>& first_interval(int path) const {
    return flights_.first[static_cast<size_t>(path)];
  }
  // The coefficients of a medium in the colours of a path.
  decltype(auto) coefficients(int path, const HomogeneousMedium& medium) const {
    return color_->media(path).of(medium);
  }
  const Ray& ray(int path) const { return rays_[static_cast<size_t>(path)]; }
  const Color& unattenuated(int path) const { return unattenuated_[static_cast<size_t>(path)]; }

  // Completes the segment of a path that was traced to `hit`, which may be empty, and attenuates its throughput.
  // Returns whether it ends on a surface, vertex `slot`. Adds the number of further rays to `traced`.
  bool complete_segment(int path, int slot, uint32_t seed, float time, Hit& hit, Color& throughput, uint64_t& traced) {
    const auto p = static_cast<size_t>(path);
    scene::MediumInterface& interface = interfaces_[static_cast<size_t>(slot)];
    unattenuated_[p] = throughput;
    if (is_in_vacuum(p, hit)) {
      interface.clear(stacks_[p]);
      return bool{hit};
    }
    BasicMediumSegment<Color> segment;
    segment.hit = hit;
    transport::complete_segment(*scene_, rays_[p], rays_[p].tfar, seed, time, stacks_[p], segment, color_->media(path));
    throughput *= segment.transmittance;
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

  // The factor of the throughput on the current segment up to a distance from its start, in metres, that is at most the
  // distance of its end, and the probability that a flight passes this part.
  BasicPassage<Color> passage_to(int path, float distance, uint32_t seed, float time) const {
    const auto p = static_cast<size_t>(path);
    Ray ray = rays_[p];
    ray.tfar = distance;
    if constexpr (M::kScattering) {
      BasicFlightSegment<Color> segment;
      segment.hit = scene_->intersect_solids(ray, seed, time);
      transport::sample_segment(*scene_, ray, distance, seed, time, stacks_[p],
                                BasicFreeFlight<Color>::without_collision(unattenuated_[p]), segment,
                                color_->media(path));
      return {segment.transmittance, segment.survival_to_end};
    }
    uint64_t rays = 0;
    return TracedConnections(*scene_).passage(false, ray, distance, seed, time, stacks_[p], rays, false,
                                              color_->media(path));
  }

  // Stores a connection; `length` is the distance of its end, metres.
  void connect(size_t slot, const Ray& ray, float length, const MediumStack& stack) {
    connections_[slot].ray = ray;
    connections_[slot].length = length;
    connections_[slot].stack = stack;
    if constexpr (M::kScattering) connections_[slot].weight = {};
  }
  // Sets the MIS weight of a connection, without its factor.
  void set_weight(size_t slot, const ConnectionWeight& weight) { connections_[slot].weight = weight; }
  // The transmittance of a connection of a path times its MIS weight.
  Color transmittance(size_t slot, int path, bool blocked, uint32_t seed, float time, uint64_t& traced) const {
    const Connection& c = connections_[slot];
    const auto passage_of = [&](bool needs_survival) {
      return TracedConnections(*scene_).passage(blocked, c.ray, c.length, seed, time, c.stack, traced, needs_survival,
                                                color_->media(path));
    };
    if constexpr (M::kScattering) {
      const auto passage = passage_of(c.weight.others > 0);
      return passage.transmittance * c.weight.at(passage.survival);
    }
    return passage_of(false).transmittance;
  }

 private:
  // Whether the segment of a path that ends at `hit` lies in no medium and at no boundary of a solid.
  bool is_in_vacuum(size_t path, const Hit& hit) const {
    return stacks_[path].empty() && !scene_->solids().atmosphere() &&
           (!hit || scene_->instances()[hit.instance].solid == scene::kNoSolid);
  }

  struct NoWeight {};
  struct Connection {
    Ray ray;
    float length;
    MediumStack stack;
    [[no_unique_address]] std::conditional_t<M::kScattering, ConnectionWeight, NoWeight> weight;
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
    const Collision& at(int slot) const { return values[static_cast<size_t>(slot)]; }
    PerPath<Collision> values;
  };
  struct NoCollisions {};
  [[no_unique_address]] std::conditional_t<M::kScattering, Collisions, NoCollisions> collisions_;
  // By path, in models with scattering media.
  static constexpr int8_t kNoCollisions = -2;
  struct Flights {
    PerPath<float> survival;
    PerPath<Color> emitted;
    PerPath<int8_t> channel;  // kept by the path; -1: none; kNoCollisions
    PerPath<Color> densities,
        next_densities;  // of paths that keep a channel, at the start of the segment and at its end
    PerPath<BasicScatteringInterval<Color>> first;
  };
  struct NoFlights {};
  [[no_unique_address]] std::conditional_t<M::kScattering, Flights, NoFlights> flights_;
  // By connection.
  PerPath<Connection> connections_;
};

}  // namespace etendue::transport
