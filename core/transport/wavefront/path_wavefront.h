// Many paths that are traced together, segment by segment.
//
// A single path needs one ray at a time, and its continuation depends on the result. Hundreds of paths side by side
// fill Embree's packets and hide the latency of memory accesses. `trace` traces the next segment of all active paths;
// then an integrator processes the vertices that were hit, in batches (`next_hits`), and the paths that left the scene
// (misses), with the functions of path_estimators.h.
//
// Nothing depends on the order of threads: the assignment of paths to packets follows from the pixels of the wavefront.
#pragma once
#include <functional>

#include "base/hash.h"
#include "sampling/sampler.h"
#include "transport/mis/mis.h"
#include "transport/path_expression/class_shares.h"
#include "transport/surface_bsdf.h"
#include "transport/wavefront/path_color.h"
#include "transport/wavefront/path_media.h"
#include "transport/wavefront/path_recorder.h"
#include "transport/wavefront/path_state.h"
#include "transport/wavefront/receiver_normal.h"
#include "transport/wavefront/record_vertices.h"

namespace etendue::transport {

// Path classes, media and wavelengths are stored separately, and only in models that have them.
static_assert(sizeof(PathState<Rgb>) == 64 && std::is_empty_v<ClassShares<StandardVacuum<false>>> &&
              std::is_empty_v<PathMedia<StandardVacuum<false>>> && std::is_empty_v<PathColor<StandardVacuum<false>>>);

template <class M>
class PathWavefront {
 public:
  using Color = typename M::Color;
  static constexpr int kCapacity = SampleTable::kPaths, kHitsAtATime = 64;
  // Random number streams below this number belong to branches of paths, those beyond to lights, the last ones to
  // points on segments in media and to directions towards emitting media.
  static constexpr uint32_t kMostBranches = 256, kSegmentStream = 0x3fffff, kMediumLightStream = 0x3ffffe;

  // Removes all paths; `sample` is the index within the pixels' sequences. All paths are cancelled when `keep_going`
  // returns false. `timed`: paths have times.
  void begin(const scene::CompiledScene& scene, const Sampler& sampler, uint32_t sample,
             const std::function<bool()>* keep_going = nullptr, bool timed = false) {
    timed_ = timed;
    recorder_ = nullptr;
    wanted_ = keep_going, given_up_ = false;
    scene_ = &scene, sampler_ = &sampler, sample_ = sample;
    size_ = travelling_ = reached_ = visited_ = hit_count_ = miss_count_ = connections_ = depth_ = 0;
    rays_traced_ = 0;
    seeded_ = scene.has_transparency(), world_bits_ = ~sampler.lane_mask();
    coherent_ = false;
    if constexpr (M::kMedia) media_.begin(scene, color_);
  }
  // The first segments of neighbouring paths are coherent: they may be traced as one packet.
  void assume_coherent() { coherent_ = true; }
  // Records the paths that this recorder follows; to be called after `begin`, which ends recording.
  void record(PathRecorder* recorder) { recorder_ = recorder; }
  // Null if nothing is recorded.
  PathRecorder* recorder() const { return recorder_; }

  // Adds a path for the pixel with this seed; paths are numbered consecutively.
  void add(uint32_t pixel_seed) { states_[static_cast<size_t>(size_++)].seed = pixel_seed; }
  // Random numbers of block 0 of all paths, for their starts.
  SampleTable& draw_start(DimensionSet wanted) {
    PerPath<uint32_t>& seeds = lane_seeds_;
    for (int i = 0; i < size_; ++i) seeds[static_cast<size_t>(i)] = state(i).seed;
    draw({seeds.data(), static_cast<size_t>(size_)}, 0, wanted);
    return random_;
  }
  // Restricts contributions to these path classes; to be called after `begin` in a model with path classes.
  void filter_paths(const Automaton& classes) { shares_.begin(classes); }
  void filter_paths_from_light(const Automaton& classes) { shares_.begin(classes, Event::light, Event::camera); }
  void launch(int path, const Ray& ray, const MediumState<M>& medium, float time = 0) {
    if constexpr (M::kClasses) shares_.launch(path);
    state(path).start(ray.origin, time);
    if constexpr (M::kScattering) media_.choose_channels(path);
    travel(path, ray, medium);
  }
  // Makes launched paths keep a colour channel in scattering media: the hero wavelength of a spectral path, else one
  // that alternates between the samples of a pixel.
  void stratify_channels() {
    if constexpr (M::kScattering)
      for (int i = 0; i < size_; ++i)
        media_.keep_channel(i, M::kSpectral ? 0 : static_cast<int>((mix_bits(state(i).seed) % 3 + sample_ % 3) % 3));
  }

  // Makes the next segments pass scattering media without collisions, or ends that.
  void ignore_collisions(bool ignore) requires(M::kScattering) { media_.ignore_collisions(size_, ignore); }

  // Removes all paths, which must have ended; new ones continue at vertices that are `length` edges from the camera.
  void begin_batch(int length) {
    size_ = travelling_ = reached_ = visited_ = hit_count_ = miss_count_ = connections_ = 0;
    depth_ = length;
  }
  // Returns the index of the path.
  int add_resumed(const PathState<Color>& path, const Ray& ray, const MediumState<M>& medium) {
    state(size_) = path;
    if constexpr (M::kScattering) media_.choose_channels(size_);
    travel(size_, ray, medium);
    return size_++;
  }

  int size() const { return size_; }
  PathState<Color>& state(int path) { return states_[static_cast<size_t>(path)]; }
  uint64_t rays_traced() const { return rays_traced_; }
  const scene::CompiledScene& scene() const { return *scene_; }

  // Traces the next segments of all active paths and the shadow rays of connections; false if no path is active.
  bool trace() {
    resolve_connections();
    if (travelling_ == 0 || given_up_) return false;
    given_up_ = wanted_ && !(*wanted_)();
    if (given_up_) return false;
    ++depth_;
    trace_rays();
    if (recorder_) [[unlikely]]
      record_misses(*this, *recorder_);
    return true;
  }

  // Makes the next batch of hits current; false if there are none left. Batches are small so that their data stays in
  // the caches.
  bool next_hits() {
    visited_ += hit_count_;
    hit_count_ = std::min(kHitsAtATime, reached_ - visited_);
    if (hit_count_ == 0) return false;
    shade();
    drawn_ = 0;
    normals_.fill({});
    if (recorder_) [[unlikely]]
      record_hits(*this, *recorder_);
    return true;
  }

  // The seed of stochastic opacity of a path; each of its rays adds a number.
  uint32_t opacity_seed(int path) const {
    return path_seed(states_[static_cast<size_t>(path)].seed & world_bits_, sample_);
  }

  // Whether the paths were cancelled; their radiance is then incomplete.
  bool cancelled() const { return given_up_; }

  // The index of the current sample within the pixels' sequences.
  uint32_t sample() const { return sample_; }

  // The number of edges from the start of the paths to the current vertices.
  int length() const { return depth_; }

  int hit_count() const { return hit_count_; }
  int path_at(int hit) const { return reached_by_[static_cast<size_t>(visited_ + hit)]; }
  PathState<Color>& state_at(int hit) { return state(path_at(hit)); }
  const scene::SurfacePoint& point(int hit) const { return points_[static_cast<size_t>(hit)]; }
  const Bsdf<M>& bsdf(int hit) const { return bsdfs_[static_cast<size_t>(hit)]; }
  Bsdf<M>& bsdf(int hit) { return bsdfs_[static_cast<size_t>(hit)]; }
  const Vec3& wo(int hit) const { return wo_[static_cast<size_t>(visited_ + hit)]; }
  // Whether a current vertex lies in a scattering medium, and its collision, without a phase function on surfaces.
  bool in_volume(int hit) const { return M::kScattering && point(hit).in_volume; }
  const Collision& collision(int hit) const requires(M::kScattering) { return media_.collision(visited_ + hit); }
  // Selects the random number stream of the current vertices: stream 0 is that of the path; others have a seed of their
  // own, which paths that branch off inherit.
  void select_rng_stream(uint32_t stream) {
    drawn_ = 0;
    for (int i = 0; i < hit_count_; ++i) {
      const uint32_t seed = state_at(i).seed;
      pixel_seeds_[static_cast<size_t>(i)] = stream == 0 ? seed : stream_seed(seed, stream);
    }
  }
  uint32_t seed(int hit) const { return pixel_seeds_[static_cast<size_t>(hit)]; }

  // Draws these dimensions for the current vertices, to be read by `random`.
  void draw(DimensionSet wanted) {
    if ((wanted & ~drawn_) == 0) return;
    drawn_ |= draw({pixel_seeds_.data(), static_cast<size_t>(hit_count_)}, static_cast<uint32_t>(depth_), wanted);
  }
  // Draws the random numbers of `lobe_draw`.
  void draw_lobes() {
    using namespace vertex_dimension;
    draw(dimensions(kBsdfDirection, 2) | (M::kDiffuse ? 0 : dimensions(kBsdfLobe, 1)));
    squares_to_cosine_hemisphere(random_.values[kBsdfDirection].data(), random_.values[kBsdfDirection + 1].data(),
                                 static_cast<size_t>(hit_count_), cosine_directions_);
  }
  // Random number `dimension` of the vertex's block.
  float random(int dimension, int hit) const {
    return random_.values[static_cast<size_t>(dimension)][static_cast<size_t>(hit)];
  }
  Vec2 random_2d(int dimension, int hit) const { return Vec2(random(dimension, hit), random(dimension + 1, hit)); }
  LobeRandom lobe_draw(int hit) const {
    return {M::kDiffuse ? 0 : random(vertex_dimension::kBsdfLobe, hit),
            random_2d(vertex_dimension::kBsdfDirection, hit), cosine_directions_[static_cast<size_t>(hit)]};
  }

  // The shares of the paths that belong to the selected path classes; empty in a model without classes.
  ClassShares<M>& shares() { return shares_; }
  // Conversions between RGB and the colours of the paths.
  PathColor<M>& color() { return color_; }

  // One light sample per current hit, by a strategy that selects a single light.
  std::span<const LightSample> sample_lights(LightSampling sampling) {
    scene_->lights().sample(light_queries(sampling), light_samples_.data(), sampling);
    return light_samples_;
  }
  // Selects the random number stream of one of several light samples of the current vertices; the first has the stream
  // of the path.
  void select_light_stream(size_t index) {
    select_rng_stream(index == 0 ? 0 : kMostBranches + static_cast<uint32_t>(index));
  }
  // One sample of the given source of the light table per current hit, with the random numbers of this light stream.
  std::span<const LightSample> sample_source(size_t source, LightSampling sampling, size_t stream) {
    select_light_stream(stream);
    scene_->lights().sample_source(source, light_queries(sampling), light_samples_.data(), sampling);
    return light_samples_;
  }
  // The same of a group of lights (LightTable::group_count).
  std::span<const LightSample> sample_group(size_t group, LightSampling sampling, size_t stream) {
    select_light_stream(stream);
    scene_->lights().sample_group(group, light_queries(sampling), light_samples_.data(), sampling);
    return light_samples_;
  }

  // A current hit as a receiver of light, after `sample_lights`: with a normal if the strategy uses normals.
  LightReceiver receiver(int hit) const { return {point(hit).position, receiver_normal(hit)}; }
  const PackedNormal& receiver_normal(int hit) const { return normals_[static_cast<size_t>(hit)]; }

  // The paths that left the scene in the last `trace`.
  int miss_count() const { return miss_count_; }
  int path_of_miss(int i) const { return misses_[static_cast<size_t>(i)]; }
  PathState<Color>& missed_path(int i) { return state(path_of_miss(i)); }
  const Vec3& miss_direction(int i) const { return miss_directions_[static_cast<size_t>(i)]; }

  // Continues a path from a hit in this direction.
  void continue_path(int hit, const Vec3& direction) {
    travel(path_at(hit), ray_from(hit, direction), medium_beyond(hit, direction));
  }
  Ray ray_from(int hit, const Vec3& direction) const {
    Ray ray;
    point(hit).spawn(direction, ray);
    return ray;
  }

  // Moves the current vertex of a path to another hit, seen from the direction `wo`.
  void move_vertex(int hit, const Hit& to, const Vec3& wo) {
    const auto i = static_cast<size_t>(hit), slot = static_cast<size_t>(visited_ + hit);
    hits_[slot] = to;
    wo_[slot] = wo;
    scene_->surfaces({&wo, 1}, {&to, 1}, &points_[i], timed_ ? &times_[i] : nullptr);
    if constexpr (M::kMedia) media_.set_media(visited_ + hit, points_[i]);
    build_bsdf<M>(points_[i], bsdfs_[i]);
    positions_.set(i, points_[i].position);
  }

  // The medium state of a path that continues from a hit in this direction.
  MediumState<M> medium_beyond(int hit, const Vec3& direction) const {
    if constexpr (M::kMedia)
      return media_.medium_beyond(visited_ + hit, point(hit), direction);
    else
      return {};
  }
  // A point on the segment traced last: the throughput there, and the probability that a flight gets there without a
  // collision.
  struct PointOnSegment {
    Color throughput;
    float survival;
  };
  // The point at a distance from the start of the segment, metres.
  PointOnSegment point_on_segment(int path, float distance) const {
    const auto p = static_cast<size_t>(path);
    if constexpr (M::kMedia) {
      const auto passage = media_.passage_to(path, distance, segment_seed(path), states_[p].time);
      return {media_.unattenuated(path) * passage.transmittance, passage.survival};
    } else {
      return {states_[p].throughput, 1};
    }
  }
  // The probability that a flight passes the segment traced last without a collision (FreeFlight::survival).
  float survival(int path) const {
    if constexpr (M::kScattering)
      return media_.survival(path);
    else
      return 1;
  }
  // An estimate of the radiance that media emit towards a current hit from a direction, up to the next surface.
  Color radiance_of_media(int hit, const Vec3& direction) requires(M::kScattering) {
    const int path = path_at(hit);
    const auto light = medium_light_on_ray(*scene_, ray_from(hit, direction), connection_seed(path), state(path).time,
                                           medium_beyond(hit, direction), EmissionPoints::few, color_.media(path));
    rays_traced_ += light.rays;
    return light.emitted;
  }
  // The radiance that media emit towards the start of the segment traced last, nearly exact.
  Color radiance_of_media_on_segment(int path) requires(M::kScattering) {
    const auto light =
        medium_light_on_ray(*scene_, media_.ray(path), segment_seed(path), state(path).time,
                            std::as_const(media_).stack(path), EmissionPoints::of_voxels, color_.media(path));
    rays_traced_ += light.rays;
    return light.emitted;
  }
  // The segments traced last, in models with scattering media.
  const PathMedia<M>& media() const { return media_; }

  // A contribution, initially zero, that is added to the path's radiance unless the segment from the hit to `distance`
  // along `direction` is occluded. Shadow rays are traced by the next `trace`.
  Color& connect(int hit, const Vec3& direction, float distance) {
    const auto slot = static_cast<size_t>(connections_++);
    Ray ray;
    point(hit).spawn_segment(direction, distance, ray);
    connecting_[slot / RayPacket::kSize].set(static_cast<int>(slot % RayPacket::kSize), ray);
    if constexpr (M::kMedia) media_.connect(slot, ray, distance, medium_beyond(hit, direction));
    connected_[slot] = static_cast<uint16_t>(path_at(hit));
    return contributions_[slot] = Color(0);
  }
  // The same for a segment from a point in a scattering medium, in these solids.
  Color& connect_from(int path, const Vec3& origin, const scene::MediumStack& medium, const Vec3& direction,
                      float distance) requires(M::kScattering) {
    const auto slot = static_cast<size_t>(connections_++);
    Ray ray;
    scene::SurfacePoint start;
    start.position = origin;
    start.spawn_segment(direction, distance, ray);
    connecting_[slot / RayPacket::kSize].set(static_cast<int>(slot % RayPacket::kSize), ray);
    media_.connect(slot, ray, distance, medium);
    connected_[slot] = static_cast<uint16_t>(path);
    return contributions_[slot] = Color(0);
  }
  // Sets the MIS weight of the last connection, without its factor.
  void set_connection_weight(const ConnectionWeight& weight) {
    media_.set_weight(static_cast<size_t>(last_connection()), weight);
  }
  static void set_connection_weight(float) {}
  int last_connection() const { return connections_ - 1; }
  // Traces the pending shadow rays now if there is no room for one more per current hit.
  void reserve_connections(int count) {
    if (connections_ + count > kCapacity) resolve_connections();
  }
  void reserve_connections() { reserve_connections(hit_count_); }
  // Random numbers of the paths that left the scene, from a stream of their own: random(dimension, miss).
  void draw_of_misses(uint32_t stream, DimensionSet wanted) {
    for (int i = 0; i < miss_count_; ++i)
      lane_seeds_[static_cast<size_t>(i)] = stream_seed(missed_path(i).seed, stream);
    draw({lane_seeds_.data(), static_cast<size_t>(miss_count_)}, static_cast<uint32_t>(depth_), wanted);
  }

 private:
  // Slightly larger than needed: with round sizes, elements of different arrays would have equal address bits 0 to 11,
  // which processors take for store-to-load dependencies.
  template <class T>
  using PerPath = std::array<T, kCapacity + 16>;
  using Packets = std::array<RayPacket, kCapacity / RayPacket::kSize>;

  // Adds a ray to its packet, long before it is traced (see RayPacket).
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

  // With the normals of receivers if the choice of a light depends on them.
  LightQueries light_queries(LightSampling sampling) {
    const bool uses_normals = scene_->lights().uses_normals(sampling);
    for (int i = 0; uses_normals && i < hit_count_; ++i)
      normals_[static_cast<size_t>(i)] = transport::receiver_normal(point(i), wo(i));
    draw(dimensions(vertex_dimension::kLightPoint, 2) | dimensions(vertex_dimension::kLightChoice, 1));
    const auto numbers = [&](int dimension) { return random_.values[static_cast<size_t>(dimension)].data(); };
    return {positions_,
            numbers(vertex_dimension::kLightChoice),
            numbers(vertex_dimension::kLightPoint),
            numbers(vertex_dimension::kLightPoint + 1),
            static_cast<size_t>(hit_count_),
            times_of_arrivals(),
            uses_normals ? normals_.data() : nullptr};
  }

  // Sets the seeds of stochastic opacity of rays, if the scene has any.
  void seed_lanes(const PerPath<uint16_t>& paths, int count, uint32_t salt) {
    for (int i = 0; seeded_ && i < count; ++i) {
      const auto lane = static_cast<size_t>(i);
      lane_seeds_[lane] = segment_seed(paths[lane]) + salt;
    }
  }
  // Streams at different vertices of a path are different. Samplers with lanes have one stream for each lane.
  uint32_t stream_seed(uint32_t seed, uint32_t stream) const {
    constexpr uint32_t kLengths = 1024;
    const uint32_t hash = hash_combine(seed, stream * kLengths + static_cast<uint32_t>(depth_) % kLengths);
    return (hash & world_bits_) | (seed & ~world_bits_);
  }
  uint32_t segment_seed(int path) const { return opacity_seed(path) + static_cast<uint32_t>(depth_); }

  // Sets the times of rays, if paths have times.
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
  void draw_free_flights();
  void shade();
  void compute_points(size_t first, size_t count);
  void build_surface_bsdf(int path, const scene::SurfacePoint& at, Bsdf<M>& bsdf);

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
  PathRecorder* recorder_ = nullptr;

  // Per path.
  PerPath<PathState<Color>> states_;
  // Per hit.
  PerPath<uint16_t> reached_by_;
  PerPath<Hit> hits_;
  PerPath<Vec3> wo_;
  // Per current hit (random numbers before the first hit: per path).
  std::array<scene::SurfacePoint, kHitsAtATime> points_;
  std::array<Bsdf<M>, kHitsAtATime> bsdfs_;
  std::array<uint32_t, kHitsAtATime> pixel_seeds_;
  std::array<float, kHitsAtATime> times_;
  SampleTable random_;
  DimensionSet drawn_ = 0;
  Vec3Lanes<kHitsAtATime> cosine_directions_, positions_;
  std::array<PackedNormal, kHitsAtATime> normals_;  // of receivers of light
  std::array<LightSample, kHitsAtATime> light_samples_;
  // Per miss.
  PerPath<uint16_t> misses_;
  PerPath<Vec3> miss_directions_;
  // Per active path, in the order of tracing.
  PerPath<uint16_t> travellers_;
  Packets travelling_packets_;
  // Per connection.
  PerPath<Color> contributions_;
  PerPath<uint16_t> connected_;
  Packets connecting_;
  // Per active path or connection.
  PerPath<uint32_t> lane_seeds_;
  [[no_unique_address]] PathColor<M> color_;
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
  if constexpr (M::kScattering) draw_free_flights();
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
  if constexpr (M::kScattering)
    return media_.sample_segment(path, reached_, segment_seed(path), path_state.time,
                                 scene_->scatters() ? random(vertex_dimension::kFreeFlight, ray) : 0, hit,
                                 path_state.throughput, rays_traced_);
  return media_.complete_segment(path, reached_, segment_seed(path), path_state.time, hit, path_state.throughput,
                                 rays_traced_);
}

// Draws the numbers of the distances to collisions, by active path. They belong to the vertices that are reached.
template <class M>
void PathWavefront<M>::draw_free_flights() {
  if (!scene_->scatters()) return;
  for (size_t i = 0; i < static_cast<size_t>(travelling_); ++i) lane_seeds_[i] = state(travellers_[i]).seed;
  draw({lane_seeds_.data(), static_cast<size_t>(travelling_)}, static_cast<uint32_t>(depth_),
       dimensions(vertex_dimension::kFreeFlight, 1));
}

// Computes the points of vertices; in models with scattering media some of them lie in volumes.
template <class M>
void PathWavefront<M>::compute_points(size_t first, size_t count) {
  const auto surfaces = [&](size_t begin, size_t end) {
    scene_->surfaces({&wo_[first + begin], end - begin}, {&hits_[first + begin], end - begin}, &points_[begin],
                     timed_ ? &times_[begin] : nullptr);
  };
  if constexpr (M::kScattering)
    set_points(media_.collisions(visited_, count), &wo_[first], points_.data(), surfaces);
  else
    surfaces(0, count);
}

// The BSDF of a vertex on a surface. Paths end their secondary wavelengths where surfaces disperse light.
template <class M>
void PathWavefront<M>::build_surface_bsdf([[maybe_unused]] int path, const scene::SurfacePoint& at, Bsdf<M>& bsdf) {
  if constexpr (M::kSpectral && !M::kDiffuse)
    if (!color_.wavelengths(path).hero_only && disperses(at))
      color_.end_secondary(path, media_.keep_first_channel(path), state(path).throughput);
  if constexpr (M::kSpectral)
    build_bsdf<M>(at, color_.wavelengths(path), bsdf);
  else
    build_bsdf<M>(at, bsdf);
}

template <class M>
void PathWavefront<M>::shade() {
  const auto first = static_cast<size_t>(visited_), count = static_cast<size_t>(hit_count_);
  for (size_t i = 0; timed_ && i < count; ++i) times_[i] = states_[reached_by_[first + i]].time;
  compute_points(first, count);
  for (size_t i = 0; i < count; ++i) {
    if constexpr (M::kMedia) media_.set_media(visited_ + static_cast<int>(i), points_[i]);
    const int number = reached_by_[first + i];
    if constexpr (M::kScattering) {
      if (points_[i].in_volume)
        bsdfs_[i].set_volume(*media_.collision(visited_ + static_cast<int>(i)).phase);
      else
        build_surface_bsdf(number, points_[i], bsdfs_[i]);
    } else {
      build_surface_bsdf(number, points_[i], bsdfs_[i]);
    }
    positions_.set(i, points_[i].position);
    pixel_seeds_[i] = state(number).seed;
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
      const Color transmittance = media_.transmittance(slot, connected_[slot], blocked, seed, path.time, rays_traced_);
      const Color contribution = contributions_[slot] * transmittance;
      if (!is_black(transmittance)) path.radiance += contribution;
      if (recorder_) [[unlikely]]
        recorder_->resolve(i, is_black(transmittance), color_.to_rgb(connected_[slot], contribution));
    } else {
      if (!blocked) path.radiance += contributions_[slot];
      if (recorder_) [[unlikely]]
        recorder_->resolve(i, blocked, blocked ? Rgb(0) : color_.to_rgb(connected_[slot], contributions_[slot]));
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
