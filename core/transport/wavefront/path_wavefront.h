// Many walks from the camera that take each step together.
//
// A path asks for one ray at a time, and what follows depends on the answer; hundreds of paths side by side keep
// Embree's packets full and let the processor work on one vertex while it waits for the data of another. `advance`
// traces the rays of all paths that still travel; between two advances an integrator goes over the vertices that were
// reached ("arrivals") and the paths that left the scene ("escapes"), with the loops of transport/gather.h.
//
// Nothing here depends on the order of threads: which paths share a packet follows from the pixels a front starts with.
#pragma once
#include <functional>

#include "base/hash.h"
#include "sampling/sampler.h"
#include "transport/path_expression/class_shares.h"
#include "transport/surface_bsdf.h"
#include "transport/wavefront/path_media.h"

namespace etendue::transport {

// What a path carries from vertex to vertex.
template <class Color>
struct alignas(64) PathState {
  Color throughput, radiance;
  Vec3 from;          // where the last direction started: what the density of a light refers to
  float pdf;          // of the last direction per solid angle; 0 if it could not have been found by sampling a light
  float eta_scale;    // by what roulette takes it for heavier: refraction's compression of radiance so far, squared
                      // indices, and the shares that branches were given
  float time;         // from 0 at the shutter's opening to 1 at its closing; 0 in a model without motion
  uint32_t seed;      // the pixel's
  bool all_specular;  // it has met nothing but mirrors and clear glass: what it sees, the camera sees

  // Filled in place: a state that is put together elsewhere and copied as words keeps the processor waiting.
  void start(const Vec3& origin, float at) {
    throughput = Color(1), radiance = Color(0);
    from = origin;
    pdf = 0, eta_scale = 1, time = at;
    all_specular = true;
  }
};

// Path classes and media are stored separately, and only in models that have them.
static_assert(sizeof(PathState<Rgb>) == 64 && std::is_empty_v<ClassShares<StandardVacuum<false>>> &&
              std::is_empty_v<PathMedia<StandardVacuum<false>>>);

template <class M>
class PathWavefront {
 public:
  using Color = typename M::Color;
  static constexpr int kCapacity = SampleTable::kPaths, kHitsAtATime = 64;
  // Twigs up to here are branches of paths, those beyond are lights.
  static constexpr uint32_t kMostBranches = 256;

  // Forgets everything; `sample` is the index within the pixels' sequence. All walks end when `wanted` says no.
  // `timed`: walks have times.
  void begin(const scene::CompiledScene& scene, const Sampler& sampler, uint32_t sample,
             const std::function<bool()>* keep_going = nullptr, bool timed = false) {
    timed_ = timed;
    wanted_ = keep_going, given_up_ = false;
    scene_ = &scene, sampler_ = &sampler, sample_ = sample;
    size_ = travelling_ = reached_ = visited_ = hit_count_ = miss_count_ = connections_ = depth_ = 0;
    rays_traced_ = 0;
    seeded_ = scene.has_transparency(), world_bits_ = ~sampler.lane_mask();
    coherent_ = false;
    if constexpr (M::kMedia) media_.begin(scene);
  }
  // Walks that are launched start close together and go about the same way: neighbours may be traced as one.
  void assume_coherent() { coherent_ = true; }

  // Adds a path for the pixel with this seed; the next number is its own.
  void add(uint32_t pixel_seed) { states_[static_cast<size_t>(size_++)].seed = pixel_seed; }
  // Numbers of block 0 of all paths, which decide where they start.
  SampleTable& draw_start(DimensionSet wanted) {
    PerPath<uint32_t>& seeds = lane_seeds_;
    for (int i = 0; i < size_; ++i) seeds[static_cast<size_t>(i)] = state(i).seed;
    draw({seeds.data(), static_cast<size_t>(size_)}, 0, wanted);
    return random_;
  }
  // Only paths of these classes count from now on: what a model with path classes is told after `begin`.
  void filter_paths(const Automaton& classes) { shares_.begin(classes); }
  void filter_paths_from_light(const Automaton& classes) { shares_.begin(classes, Event::light, Event::camera); }
  void launch(int path, const Ray& ray, const MediumState<M>& medium, float time = 0) {
    if constexpr (M::kClasses) shares_.launch(path);
    state(path).start(ray.origin, time);
    travel(path, ray, medium);
  }

  // Takes other paths in place of all that came to their end; those are at a vertex of so many edges from the camera.
  void begin_batch(int length) {
    size_ = travelling_ = reached_ = visited_ = hit_count_ = miss_count_ = connections_ = 0;
    depth_ = length;
  }
  // Returns the path's number.
  int add_resumed(const PathState<Color>& path, const Ray& ray, const MediumState<M>& medium) {
    state(size_) = path;
    travel(size_, ray, medium);
    return size_++;
  }

  int size() const { return size_; }
  PathState<Color>& state(int path) { return states_[static_cast<size_t>(path)]; }
  uint64_t rays_traced() const { return rays_traced_; }
  const scene::CompiledScene& scene() const { return *scene_; }

  // Traces all rays that travel, and those that connections asked for; false if no walk goes on.
  bool trace() {
    resolve_connections();
    if (travelling_ == 0 || given_up_) return false;
    given_up_ = wanted_ && !(*wanted_)();
    if (given_up_) return false;
    ++depth_;
    trace_rays();
    return true;
  }

  // Takes the next of the vertices that were reached; false if there are none left. A few at a time, so that what is
  // known of them stays near the processor.
  bool next_hits() {
    visited_ += hit_count_;
    hit_count_ = std::min(kHitsAtATime, reached_ - visited_);
    if (hit_count_ == 0) return false;
    shade();
    drawn_ = 0;
    return true;
  }

  // What decides, with a number for each of its rays, where the path passes through by stochastic opacity.
  uint32_t opacity_seed(int path) const {
    return path_seed(states_[static_cast<size_t>(path)].seed & world_bits_, sample_);
  }

  // The walks were ended before their time: what they found is no estimate.
  bool cancelled() const { return given_up_; }

  // The index of the present sample within the pixels' sequence.
  uint32_t sample() const { return sample_; }

  // Edges from where the walks started to the present vertices.
  int length() const { return depth_; }

  // The vertices that `arrive` took.
  int hit_count() const { return hit_count_; }
  int path_at(int hit) const { return reached_by_[static_cast<size_t>(visited_ + hit)]; }
  PathState<Color>& state_at(int hit) { return state(path_at(hit)); }
  const scene::SurfacePoint& point(int hit) const { return points_[static_cast<size_t>(hit)]; }
  const Bsdf<M>& bsdf(int hit) const { return bsdfs_[static_cast<size_t>(hit)]; }
  const Vec3& wo(int hit) const { return wo_[static_cast<size_t>(visited_ + hit)]; }
  // From here on the numbers of the present vertices are those of one of their twigs: 0 is the path itself, any other
  // has a seed of its own, which paths that branch off there inherit.
  void select_rng_stream(uint32_t stream) {
    drawn_ = 0;
    for (int i = 0; i < hit_count_; ++i) {
      const uint32_t seed = state_at(i).seed;
      // Twigs of the same path at other vertices are others.
      constexpr uint32_t kLengths = 1024;
      pixel_seeds_[static_cast<size_t>(i)] =
          stream == 0 ? seed : hash_combine(seed, stream * kLengths + static_cast<uint32_t>(depth_) % kLengths);
    }
  }
  uint32_t seed(int hit) const { return pixel_seeds_[static_cast<size_t>(hit)]; }

  // Draws these of the numbers that the present vertices own, for `random` to give out.
  void draw(DimensionSet wanted) {
    if ((wanted & ~drawn_) == 0) return;
    drawn_ |= draw({pixel_seeds_.data(), static_cast<size_t>(hit_count_)}, static_cast<uint32_t>(depth_), wanted);
  }
  // Draws the numbers of `lobe_draw`.
  void draw_lobes() {
    using namespace vertex_dimension;
    draw(dimensions(kBsdfDirection, 2) | (M::kDiffuse ? 0 : dimensions(kBsdfLobe, 1)));
    squares_to_cosine_hemisphere(random_.values[kBsdfDirection].data(), random_.values[kBsdfDirection + 1].data(),
                                 static_cast<size_t>(hit_count_), cosine_directions_);
  }
  // Number `dimension` of the block that the vertex owns.
  float random(int dimension, int hit) const {
    return random_.values[static_cast<size_t>(dimension)][static_cast<size_t>(hit)];
  }
  Vec2 random_2d(int dimension, int hit) const { return Vec2(random(dimension, hit), random(dimension + 1, hit)); }
  LobeRandom lobe_draw(int hit) const {
    return {M::kDiffuse ? 0 : random(vertex_dimension::kBsdfLobe, hit),
            random_2d(vertex_dimension::kBsdfDirection, hit), cosine_directions_[static_cast<size_t>(hit)]};
  }

  // Which part of what the walks carry belongs to the classes that are asked for; empty in a model without classes.
  ClassShares<M>& shares() { return shares_; }

  // A point on a light for each arrival, by one of the strategies that take a single light.
  std::span<const LightSample> sample_lights(LightStrategy strategy) {
    scene_->lights().sample(draw_lights(), light_samples_.data(), strategy);
    return light_samples_;
  }
  // A point on one of the light table's sources for each arrival, from numbers of a twig of its own but for the first.
  std::span<const LightSample> sample_source(size_t source) {
    select_rng_stream(source == 0 ? 0 : kMostBranches + static_cast<uint32_t>(source));
    scene_->lights().sample_source(source, draw_lights(), light_samples_.data());
    return light_samples_;
  }

  // The paths that the last advance found to leave the scene.
  int miss_count() const { return miss_count_; }
  int path_of_miss(int i) const { return misses_[static_cast<size_t>(i)]; }
  PathState<Color>& missed_path(int i) { return state(path_of_miss(i)); }
  const Vec3& miss_direction(int i) const { return miss_directions_[static_cast<size_t>(i)]; }

  // The path goes on from an arrival in this direction.
  void continue_path(int hit, const Vec3& direction) {
    travel(path_at(hit), ray_from(hit, direction), medium_beyond(hit, direction));
  }
  Ray ray_from(int hit, const Vec3& direction) const {
    Ray ray;
    point(hit).spawn(direction, ray);
    return ray;
  }

  // The medium state of a path that continues from a hit in this direction.
  MediumState<M> medium_beyond(int hit, const Vec3& direction) const {
    if constexpr (M::kMedia)
      return media_.medium_beyond(visited_ + hit, point(hit), direction);
    else
      return {};
  }
  // The throughput on the segment traced last, at a distance from its start, metres.
  Color throughput_after(int path, float distance) const {
    const auto p = static_cast<size_t>(path);
    if constexpr (M::kMedia)
      return media_.throughput_after(path, distance, segment_seed(path), states_[p].time);
    else
      return states_[p].throughput;
  }

  // A sum, zero at first, that the path gains unless something lies between the arrival and `distance` along
  // `direction`; decided for all at once by the next `advance`.
  Color& connect(int hit, const Vec3& direction, float distance) {
    const auto slot = static_cast<size_t>(connections_++);
    Ray ray;
    point(hit).spawn_segment(direction, distance, ray);
    connecting_[slot / RayPacket::kSize].set(static_cast<int>(slot % RayPacket::kSize), ray);
    if constexpr (M::kMedia) media_.connect(slot, ray, distance, medium_beyond(hit, direction));
    connected_[slot] = static_cast<uint16_t>(path_at(hit));
    return contributions_[slot] = Color(0);
  }
  // Decides about those so far at once if there is no room for one more from every arrival.
  void reserve_connections() {
    if (connections_ + hit_count_ > kCapacity) resolve_connections();
  }

 private:
  // A little more than is used: processors take a store for the source of a load where addresses agree in their last
  // twelve bits, and arrays of a round size would agree everywhere.
  template <class T>
  using PerPath = std::array<T, kCapacity + 16>;
  using Packets = std::array<RayPacket, kCapacity / RayPacket::kSize>;

  // Rays are written into packets long before they are traced (see RayPacket).
  void travel(int path, const Ray& ray, const MediumState<M>& medium) {
    if constexpr (M::kMedia) {
      media_.stack(path) = medium;
      media_.set_ray(path, ray);
    }
    const auto slot = static_cast<size_t>(travelling_++);
    travelling_packets_[slot / RayPacket::kSize].set(static_cast<int>(slot % RayPacket::kSize), ray);
    travellers_[slot] = static_cast<uint16_t>(path);
  }

  DimensionSet draw(std::span<const uint32_t> pixel_seeds, uint32_t block, DimensionSet wanted) {
    return sampler_->blocks(pixel_seeds, sample_, block, wanted, random_);
  }

  LightQueries draw_lights() {
    draw(dimensions(vertex_dimension::kLightPoint, 2) | dimensions(vertex_dimension::kLightChoice, 1));
    const auto numbers = [&](int dimension) { return random_.values[static_cast<size_t>(dimension)].data(); };
    return {positions_,
            numbers(vertex_dimension::kLightChoice),
            numbers(vertex_dimension::kLightPoint),
            numbers(vertex_dimension::kLightPoint + 1),
            static_cast<size_t>(hit_count_),
            times_of_arrivals()};
  }

  // Seeds for the rays of these paths, where stochastic opacity asks for them.
  void seed_lanes(const PerPath<uint16_t>& paths, int count, uint32_t salt) {
    for (int i = 0; seeded_ && i < count; ++i) {
      const auto lane = static_cast<size_t>(i);
      lane_seeds_[lane] = segment_seed(paths[lane]) + salt;
    }
  }
  uint32_t segment_seed(int path) const { return opacity_seed(path) + static_cast<uint32_t>(depth_); }

  // Tells rays when they are, where walks have times.
  void time_lanes(const PerPath<uint16_t>& paths, int count, Packets& packets) {
    for (int i = 0; timed_ && i < count; ++i)
      packets[static_cast<size_t>(i / RayPacket::kSize)].set_time(i % RayPacket::kSize,
                                                                  state(paths[static_cast<size_t>(i)]).time);
  }
  const float* times_of_arrivals() const { return timed_ ? times_.data() : nullptr; }

  void trace_rays();
  void trace_connections();
  void resolve_connections();
  bool complete_segment(int ray, bool has_hit);
  void shade();

  static constexpr uint32_t kConnectionSalt = 0x5bd1e995U;
  uint32_t connection_seed(int path) const { return segment_seed(path) + kConnectionSalt; }

  const scene::CompiledScene* scene_ = nullptr;
  const Sampler* sampler_ = nullptr;
  uint32_t sample_ = 0, world_bits_ = ~0U;
  int size_ = 0, travelling_ = 0, reached_ = 0, visited_ = 0, hit_count_ = 0, miss_count_ = 0, connections_ = 0,
      depth_ = 0;
  uint64_t rays_traced_ = 0;
  bool seeded_ = false, timed_ = false, coherent_ = false, given_up_ = false;
  const std::function<bool()>* wanted_ = nullptr;

  // By path.
  PerPath<PathState<Color>> states_;
  // By vertex reached.
  PerPath<uint16_t> reached_by_;
  PerPath<Hit> hits_;
  PerPath<Vec3> wo_;
  // By arrival (random numbers before the first: by path).
  std::array<scene::SurfacePoint, kHitsAtATime> points_;
  std::array<Bsdf<M>, kHitsAtATime> bsdfs_;
  std::array<uint32_t, kHitsAtATime> pixel_seeds_;
  std::array<float, kHitsAtATime> times_;
  SampleTable random_;
  DimensionSet drawn_ = 0;
  Vec3Lanes<kHitsAtATime> cosine_directions_, positions_;
  std::array<LightSample, kHitsAtATime> light_samples_;
  // By escape.
  PerPath<uint16_t> misses_;
  PerPath<Vec3> miss_directions_;
  // In the order they travel.
  PerPath<uint16_t> travellers_;
  Packets travelling_packets_;
  // By connection.
  PerPath<Color> contributions_;
  PerPath<uint16_t> connected_;
  Packets connecting_;
  // Of one or the other.
  PerPath<uint32_t> lane_seeds_;
  [[no_unique_address]] ClassShares<M> shares_;
  [[no_unique_address]] PathMedia<M> media_;
};

template <class M>
void PathWavefront<M>::trace_rays() {
  seed_lanes(travellers_, travelling_, 0);
  time_lanes(travellers_, travelling_, travelling_packets_);
  for (int first = 0; first < travelling_; first += RayPacket::kSize) {
    RayPacket& packet = travelling_packets_[static_cast<size_t>(first / RayPacket::kSize)];
    const int count = std::min(RayPacket::kSize, travelling_ - first);
    const uint32_t* seeds = &lane_seeds_[static_cast<size_t>(first)];
    if constexpr (M::kMedia)
      scene_->intersect_solids(packet, count, coherent_ && depth_ == 1, seeds);
    else
      scene_->intersect(packet, count, coherent_ && depth_ == 1, seeds);
  }
  rays_traced_ += static_cast<uint64_t>(travelling_);
  reached_ = visited_ = hit_count_ = miss_count_ = 0;
  for (int i = 0; i < travelling_; ++i) {
    const RayPacket& packet = travelling_packets_[static_cast<size_t>(i / RayPacket::kSize)];
    const int lane = i % RayPacket::kSize;
    bool has_hit = packet.has_hit(lane);
    if constexpr (M::kMedia) has_hit = complete_segment(i, has_hit);
    if (has_hit) {
      const auto slot = static_cast<size_t>(reached_++);
      reached_by_[slot] = travellers_[static_cast<size_t>(i)];
      if constexpr (!M::kMedia) packet.get(lane, hits_[slot]);
      wo_[slot] = -packet.direction(lane);
    } else {
      const auto slot = static_cast<size_t>(miss_count_++);
      misses_[slot] = travellers_[static_cast<size_t>(i)];
      miss_directions_[slot] = packet.direction(lane);
    }
  }
  travelling_ = 0;
}

// Completes the segment of a ray and stores its hit as the next vertex; returns false if it hits nothing.
template <class M>
bool PathWavefront<M>::complete_segment(int ray, bool has_hit) {
  const int path = travellers_[static_cast<size_t>(ray)];
  Hit& hit = hits_[static_cast<size_t>(reached_)];
  if (has_hit)
    travelling_packets_[static_cast<size_t>(ray / RayPacket::kSize)].get(ray % RayPacket::kSize, hit);
  else
    hit = Hit();
  PathState<Color>& path_state = state(path);
  return media_.complete_segment(path, reached_, segment_seed(path), path_state.time, hit, path_state.throughput,
                                 rays_traced_);
}

template <class M>
void PathWavefront<M>::shade() {
  const auto first = static_cast<size_t>(visited_), count = static_cast<size_t>(hit_count_);
  for (size_t i = 0; timed_ && i < count; ++i) times_[i] = states_[reached_by_[first + i]].time;
  scene_->surfaces({&wo_[first], count}, {&hits_[first], count}, points_.data(), times_of_arrivals());
  for (size_t i = 0; i < count; ++i) {
    PathState<Color>& path = states_[reached_by_[first + i]];
    if constexpr (M::kMedia) media_.set_media(visited_ + static_cast<int>(i), points_[i]);
    build_bsdf<M>(points_[i], bsdfs_[i]);
    positions_.set(i, points_[i].position);
    pixel_seeds_[i] = path.seed;
  }
}

template <class M>
void PathWavefront<M>::resolve_connections() {
  trace_connections();
  for (int i = 0; i < connections_; ++i) {
    const auto slot = static_cast<size_t>(i);
    const bool blocked = connecting_[slot / RayPacket::kSize].is_occluded(i % RayPacket::kSize);
    PathState<Color>& path = state(connected_[slot]);
    if constexpr (M::kMedia) {
      const uint32_t seed = connection_seed(connected_[slot]);
      const Color transmittance = media_.transmittance(slot, blocked, seed, path.time, rays_traced_);
      if (!is_black(transmittance)) path.radiance += contributions_[slot] * transmittance;
    } else if (!blocked) {
      path.radiance += contributions_[slot];
    }
  }
  connections_ = 0;
}

template <class M>
void PathWavefront<M>::trace_connections() {
  if constexpr (M::kMedia)
    if (!TracedConnections(*scene_).use_packets()) return;
  seed_lanes(connected_, connections_, kConnectionSalt);
  time_lanes(connected_, connections_, connecting_);
  for (int first = 0; first < connections_; first += RayPacket::kSize)
    scene_->occluded(connecting_[static_cast<size_t>(first / RayPacket::kSize)],
                     std::min(RayPacket::kSize, connections_ - first), &lane_seeds_[static_cast<size_t>(first)]);
  rays_traced_ += static_cast<uint64_t>(connections_);
}

}  // namespace etendue::transport
