// The two subpaths of every bidirectional sample of a block, with the data of their MIS weights.
//                                                                       [Lang, sec. 9.3, eq. 9.78-9.110, corrected]
#pragma once
#include "integrator/bdpt/light_vertices.h"
#include "integrator/bdpt/merge_map.h"
#include "integrator/bdpt/techniques.h"
#include "integrator/shared/light_path_estimators.h"
#include "transport/mis/mis.h"
#include "transport/mis/mis_chain.h"
#include "transport/path_expression/class_join.h"
#include "transport/wavefront/lobe_split.h"
#include "transport/wavefront/medium_light.h"

namespace etendue::integrator {

// The parameters of the integrator, shared by all blocks.
struct BidirectionalOptions {
  transport::MisHeuristic heuristic;
  int max_depth, roulette_start;
  Techniques excluded = {}, shown = {};
  bool apply_mis = true;
  bool reuse = true;  // connect all pairs of vertices
  std::optional<transport::ClassJoin> classes;
  const MergeMap* merges = nullptr;     // vertices of light subpaths that camera subpaths are merged with; null: none
  transport::LobeSplit merge_split{0};  // vertices are merged on surfaces with lobes that are rough
  // How light samples (s = 1) are chosen, with the points of emission. Not by the tree or by learned probabilities if
  // vertices are merged: stored vertices have no room for the ratio of densities.
  LightSampling lights = LightStrategy::emission_auto;

  bool too_long(int edges) const { return max_depth > 0 && edges > max_depth; }
  bool contributes(int s, int t) const { return !excluded.contains(s, t) && (shown.empty() || shown.contains(s, t)); }
};

// The join of the path classes of a model; nothing if all paths count.
inline std::optional<transport::ClassJoin> class_join(const transport::Model& model) {
  return model.classes ? std::optional<transport::ClassJoin>(*model.paths) : std::nullopt;
}

template <class M>
class BidirectionalSubpaths {
 public:
  using PathWavefront = transport::PathWavefront<M>;
  using Color = typename M::Color;
  using Start = typename LightSubpaths<M>::Start;
  using Vertex = LightVertex<M>;
  // Size of a block: fewer paths than a wavefront can hold, so that their data stays in the caches.
  static constexpr int kWidth = 16, kHeight = 16;
  static constexpr size_t kPaths = size_t{kWidth} * kHeight;

  // The MIS weight of a connection. In scattering media it depends on the connected segment.
  using Weight = std::conditional_t<M::kScattering, transport::ConnectionWeight, float>;

  PathWavefront light, camera;

  // `techniques` are the only techniques of each path; empty: all. `pixels` is the area of the image in pixels. `guide`
  // guides the directions of camera subpaths; null: none.
  void begin(const RenderContext& context, const BidirectionalOptions& options, std::span<const Technique> techniques,
             float pixels, const guiding::RadianceGuide* guide = nullptr) {
    context_ = &context;
    options_ = &options;
    techniques_ = techniques;
    pixels_ = pixels;
    guide_ = guide;
    light_guided_.fill({});
    camera_guided_.fill({});
    merge_density_ = options.merges ? options.merges->density() : 0;
    chooses_by_receiver_ = options.lights.learned || lights().uses_normals(options.lights);
  }

  // Without reuse, each path is one connection of the ends of two subpaths. The numbers of vertices are sampled from
  // geometric distributions, so that every technique has a positive probability.    [Lang, sec. 9.3.1, eq. 9.36-9.75,
  // corrected]
  void sample_techniques(const PixelBlock& block, const PixelOrder& order) {
    const int least = context_->camera->can_be_hit() ? 0 : 1;
    const PixelSeeds seed_of(*context_->sampler, context_->seed, block.sample % film::kHalfBuffers);
    for (int i = 0; i < order.size(); ++i) {
      const uint32_t seed = seed_of(block.x + order.x(i), block.y + order.y(i));
      const uint32_t first = mix_bits(path_seed(seed, block.sample) + 0x2545f491U);
      const auto path = static_cast<size_t>(i);
      inverse_probability_[path] = 1;
      sampled_techniques_[path] = {sample_vertex_count(first, inverse_probability_[path]),
                                   least + sample_vertex_count(mix_bits(first), inverse_probability_[path])};
    }
    techniques_ = {sampled_techniques_.data(), static_cast<size_t>(order.size())};
  }

  // ---- Techniques.

  // Whether any technique of the path has more than one light vertex, or more than one camera vertex.
  bool has_light_subpath(int path) const {
    return techniques_.empty() || technique(path).has_more_light_vertices_than(1);
  }
  bool has_camera_subpath(int path) const {
    return techniques_.empty() || technique(path).has_more_camera_vertices_than(1);
  }
  // Whether any technique needs further vertices beyond the current hit i.
  bool continues_from_light(int i) const {
    return techniques_.empty() || technique(light.path_at(i)).has_more_light_vertices_than(light.length() + 1);
  }
  bool continues_from_camera(int i) const {
    return techniques_.empty() || technique(camera.path_at(i)).has_more_camera_vertices_than(camera.length() + 1);
  }
  bool contributes(int path, int s, int t) const {
    if (!techniques_.empty() && !technique(path).includes(s, t)) return false;
    return options_->contributes(s, t);
  }

  // Whether a technique of the path starts on a light that is sampled with the path's own random numbers.
  bool needs_light(int path) const {
    if (techniques_.empty()) return true;
    const Technique& t = technique(path);
    return t.has_more_light_vertices_than(1) || t.includes(1, 1);
  }

  // ---- Vertices.

  void start_light(const Start& start) {
    const Emission& e = start.emission;
    start_lights_[static_cast<size_t>(start.path)] = e.light;
    MisChain& chain = light_chains_[static_cast<size_t>(start.path)];
    chain.start(e.density.first, !e.density.delta, e.density.infinite);
    chain.sample_direction(e.density.second, start.point ? std::abs(glm::dot(start.point->ng, e.direction)) : 1.0f);
  }
  void clear_light_vertices() {
    pool_.clear();
    last_light_vertex_.fill(nullptr);
  }
  void start_camera() {
    for (int i = 0; i < camera.size(); ++i) {
      MisChain& chain = camera_chains_[static_cast<size_t>(i)];
      const bool lens_can_be_hit = context_->camera->can_be_hit();
      chain.start(lens_can_be_hit ? 1 / context_->camera->lens_area() : 1, lens_can_be_hit, false);
    }
  }

  // Computes the MIS quantities of the current hits.
  void add_light_hits() {
    add_hits(light, light_chains_, light_vertices_, light_rule());
    find_guided_densities(light, light_guided_);
    if (chooses_by_receiver_ && light.length() == 1) weigh_light_samples_of_light_hits();
  }
  void add_camera_hits() {
    if (camera.length() == 1) set_lens_directions();
    add_hits(camera, camera_chains_, camera_vertices_, camera_rule());
    find_guided_densities(camera, camera_guided_);
    if (!options_->excluded.empty()) store_camera_vertices();
  }
  // Continues from the current hit i by a BSDF sample.
  void scatter_light(int i, const LobeSample<Color>& s) {
    const float reverse_pdf = s.delta ? 0 : guided_pdf(light, light_guided_, i, s.wi, light.wo(i));
    scatter(light, light_chains_, light_vertices_, light_rule(), i, s, reverse_pdf);
  }
  void scatter_camera(int i, const LobeSample<Color>& s) {
    const float reverse_pdf = s.delta ? 0 : camera.bsdf(i).pdf(s.wi, camera.wo(i));
    scatter(camera, camera_chains_, camera_vertices_, camera_rule(), i, s, reverse_pdf);
  }
  // The density with which the camera subpath continues from hit i in a direction, where the BSDF has `bsdf_pdf`.
  float camera_pdf(int i, const Vec3& wi, float bsdf_pdf) const {
    return camera_guided_[static_cast<size_t>(i)].pdf(wi, bsdf_pdf);
  }

  // Stores the current light vertices for connections.
  void store_light_vertices(const LightSubpaths<M>& starts) {
    for (int i = 0; i < light.hit_count(); ++i) {
      if (!light.bsdf(i).has_non_delta_lobe()) {
        // Specular vertices cannot be connected; they are stored only where the MIS sum needs single terms.
        if (options_->excluded.empty()) continue;
      }
      const int path = light.path_at(i);
      if (!techniques_.empty() && technique(path).s != light.length() + 1) continue;
      const Vertex*& last = last_light_vertex_[static_cast<size_t>(path)];
      Vertex& v = pool_.add();
      v.point = light.point(i);
      v.bsdf = light.bsdf(i);
      v.wo = light.wo(i);
      v.bsdf.rebind(v.point.shading, v.point.ng);
      v.flux = light.state(path).throughput * starts.flux(path);
      v.mis = light_vertices_[static_cast<size_t>(i)];
      v.guided = light_guided_[static_cast<size_t>(i)];
      v.length = light.length();
      v.previous = last;
      if constexpr (M::kClasses) light.shares().copy(path, v.shares);
      last = &v;
    }
  }
  // The last stored vertex of a light subpath, or null.
  const Vertex* last_light_vertex(int path) const { return last_light_vertex_[static_cast<size_t>(path)]; }

  // |cos| between a direction and the normal of a point; 1 in volumes.
  static float cosine(const scene::SurfacePoint& point, const Vec3& direction) {
    if constexpr (M::kScattering)
      if (point.in_volume) return 1;
    return std::abs(glm::dot(point.ng, direction));
  }

  // ---- MIS weights of the techniques, divided by the probability of a sampled technique.

  // The MIS weight of the directly visible light: (1, 1).
  Weight light_view_weight(const Start& start, float pixels, const Vec3& wi, float distance) const {
    const EmissionDensity& emission = start.emission.density;
    const float hit_ratio = is_enabled(0, 2) ? light_rule().ratio(pixels / pixels_ / emission.first) : 0;
    float lens_ratio = 0;
    if (context_->camera->can_be_hit() && is_enabled(2, 0)) {
      const float cosine = context_->camera->cosine(-wi, start.emission.time), area = context_->camera->lens_area();
      lens_ratio =
          emission.infinite ? emission.second * cosine : emission_direction_density(start, wi) * cosine / sqr(distance);
      lens_ratio = camera_rule().ratio(lens_ratio * area);
    }
    return weight_of_connection(start.path, 1, 1, hit_ratio, lens_ratio);
  }

  // The subpath hit the lens: t = 0. `survival` is the probability that a flight reaches it.
  float lens_hit_weight(int path, const CameraRays::LensHit& hit, float survival) {
    const int s = light.length() + 1;
    if (options_->too_long(light.length()) || !contributes(path, s, 0)) return 0;
    MisChain chain = light_chains_[static_cast<size_t>(path)];
    const MisVertex on_lens = chain.add_vertex(light_rule(), sqr(hit.distance), hit.cosine, survival);
    const float sum = light_sum(on_lens, s - 1, last_light_vertex_[static_cast<size_t>(path)],
                                1 / context_->camera->lens_area(), hit.density / pixels_, 0, false);
    return weight(path, s, 0, sum, 0);
  }

  // The vertex is connected to the camera: t = 1.
  Weight camera_connection_weight(int i, const CameraRays::View& view) {
    const int s = light.length() + 1, path = light.path_at(i);
    const scene::SurfacePoint& point = light.point(i);
    const Bsdf<M>& bsdf = light.bsdf(i);
    const Vec3& wo = light.wo(i);
    const float lights =
        light_sum(light_vertices_[static_cast<size_t>(i)], s - 1, last_light_vertex_[static_cast<size_t>(path)],
                  view.importance * cosine(point, view.wi) / pixels_, guided_pdf(light, light_guided_, i, view.wi, wo),
                  1, can_merge(point, bsdf));
    float lens = 0;
    if (context_->camera->can_be_hit() && is_enabled(s + 1, 0)) {
      const float distance = view.distance, c = context_->camera->cosine(-view.wi, light.state_at(i).time);
      lens = camera_rule().ratio(bsdf.pdf(wo, view.wi) * c / sqr(distance) * context_->camera->lens_area());
    }
    return weight_of_connection(path, s, 1, lights, lens);
  }

  // The camera subpath hit a light: s = 0.
  float emission_weight(int i) {
    const int t = camera.length() + 1, path = camera.path_at(i);
    if (options_->too_long(t - 1) || !contributes(path, 0, t)) return 0;
    const scene::SurfacePoint& point = camera.point(i);
    const uint32_t light_index = context_->scene->light_at(point);
    if (light_index == scene::InstanceData::kNotALight) return weight(path, 0, t, 0, 0);
    const auto d = context_->scene->lights().emission_density(light_index, glm::dot(point.ng, camera.wo(i)),
                                                              camera.state_at(i).time);
    MisVertex on_light = camera_vertices_[static_cast<size_t>(i)];
    on_light.connection *= light_sample_power(light_index, camera.state_at(i), on_light);
    return weight(path, 0, t, 0, camera_sum(path, on_light, t - 1, d.first, d.second, 0, false));
  }

  // The camera subpath left the scene: s = 0.
  float environment_weight(int i) {
    const int t = camera.length() + 1, path = camera.path_of_miss(i);
    if (options_->too_long(t - 1) || !contributes(path, 0, t)) return 0;
    const Vec3& direction = camera.miss_direction(i);
    const auto d = context_->scene->lights().environment_emission_density(direction);
    MisChain chain = camera_chains_[static_cast<size_t>(path)];
    if (camera.length() == 1) {
      // A direct view of the environment: (1, 1) is the only other technique.
      const float pixels = context_->camera->pixels_per_area(direction, 1, camera.missed_path(i).time) / pixels_;
      const float density = pixels * camera.survival(path);
      const bool seen = context_->camera->sees_environment() && is_enabled(1, 1);
      return weight(path, 0, t, 0, seen && density > 0 ? camera_rule().ratio(d.first / density) : 0.0f);
    }
    MisVertex at_infinity = chain.add_vertex_at_infinity(camera_rule(), camera.survival(path));
    at_infinity.connection *= light_sample_power(lights().environment_number(), camera.missed_path(i), at_infinity);
    return weight(path, 0, t, 0, camera_sum(path, at_infinity, t - 1, d.first, d.second, 0, false));
  }

  // Light of media is found by camera subpaths only: on their last segment (s = 0), or by a direction sample at the
  // current vertices (s = 1).
  transport::TechniqueWeight medium_technique(int path, int s) const {
    const int t = camera.length() + 1;
    if (options_->too_long(camera.length() + s) || !contributes(path, s, t)) return {0, false};
    return {options_->reuse ? 1 : inverse_probability_[static_cast<size_t>(path)],
            options_->apply_mis && is_enabled(1 - s, s == 0 ? t - 1 : t + 1)};
  }

  // A light sample: s = 1. The weight is divided by the density of the sample.
  Weight light_sample_weight(int i, const LightSample& sample, float pdf) {
    const int t = camera.length() + 1, path = camera.path_at(i);
    const scene::SurfacePoint& point = camera.point(i);
    const float cos_point = cosine(point, sample.wi);
    const EmissionDensity d = context_->scene->lights().emission_density(sample, camera.state_at(i).time);
    const float hits =
        sample.delta || !is_enabled(0, t + 1) ? 0.0f : light_rule().ratio(camera_pdf(i, sample.wi, pdf) / sample.pdf);
    const float reverse_pdf = d.second * (d.infinite ? cos_point : cos_point / sqr(sample.distance));
    const float cameras = camera_sum(path, camera_vertices_[static_cast<size_t>(i)], t - 1, reverse_pdf,
                                     camera.bsdf(i).pdf(sample.wi, camera.wo(i)), 1, can_merge(point, camera.bsdf(i)));
    return weight_of_connection(path, 1, t, hits, relative_to_light_sample(cameras, sample)) / sample.pdf;
  }

  // The connection of light vertex y and the current camera hit i. The densities are those of y as sampled from i and
  // of i as sampled from y, per area; `wi` is the direction from i to y.
  Weight connection_weight(int i, const Vertex& y, const Vec3& wi, float density_at_y, float density_at_z) const {
    const int s = y.length + 1, t = camera.length() + 1, path = camera.path_at(i);
    const float lights = light_sum(y.mis, s - 1, &y, density_at_y, y.guided.pdf(y.wo, y.bsdf.pdf(-wi, y.wo)), t,
                                   can_merge(y.point, y.bsdf));
    const float cameras =
        camera_sum(path, camera_vertices_[static_cast<size_t>(i)], t - 1, density_at_z,
                   camera.bsdf(i).pdf(wi, camera.wo(i)), s, can_merge(camera.point(i), camera.bsdf(i)));
    return weight_of_connection(path, s, t, lights, cameras);
  }

  // The merge of the current camera hit i with a light vertex. `pdf` is the density of the direction to the previous
  // light vertex, as sampled at hit i.
  float merge_weight(int i, const MergeVertex& y, float pdf) const {
    const MisVertex light_vertex = y.mis(), &camera_vertex = camera_vertices_[static_cast<size_t>(i)];
    const MisRule rule = camera_rule();
    const float lights = light_vertex.sum_before(rule, pdf) / rule.merge(light_vertex.pdf);
    const float reverse_pdf = camera.bsdf(i).pdf(y.wo, camera.wo(i));
    const float cameras = camera_vertex.sum_before(rule, reverse_pdf) / rule.merge(camera_vertex.pdf);
    return MisRule::weight(options_->heuristic, lights, cameras);
  }
  const transport::MisVertex& light_vertex(int i) const { return light_vertices_[static_cast<size_t>(i)]; }

  // Whether subpaths of both sides that end at this vertex can be merged.
  bool can_merge(const scene::SurfacePoint& point, const Bsdf<M>& bsdf) const {
    return merge_density_ > 0 && is_on_surface(point) && options_->merge_split.has_rough(bsdf);
  }

 private:
  static bool is_on_surface(const scene::SurfacePoint& point) {
    if constexpr (M::kScattering)
      return !point.in_volume;
    else
      return (void)point, true;
  }

  using MisVertex = transport::MisVertex;
  using MisChain = transport::MisChain;
  using MisRule = transport::MisRule;
  static constexpr size_t kHitsAtATime = PathWavefront::kHitsAtATime;
  template <class T>
  using PerPath = std::array<T, kPaths>;
  using PerHit = std::array<MisVertex, kHitsAtATime>;
  using GuidedPerHit = std::array<guiding::GuidedDensity, kHitsAtATime>;

  // ---- Guided directions of camera subpaths.

  void find_guided_densities(const PathWavefront& paths, GuidedPerHit& guided) const {
    if (!guide_) return;
    for (int i = 0; i < paths.hit_count(); ++i)
      guided[static_cast<size_t>(i)] = {*guide_, paths.point(i).position, paths.bsdf(i).has_non_delta_lobe()};
  }
  // The density with which a camera subpath that arrives at hit i from `wo` continues to `wi`.
  static float guided_pdf(const PathWavefront& paths, const GuidedPerHit& guided, int i, const Vec3& wo,
                          const Vec3& wi) {
    return guided[static_cast<size_t>(i)].pdf(wi, paths.bsdf(i).pdf(wo, wi));
  }

  // ---- The choice of the light by light samples (s = 1), relative to that by light subpaths: r in mis_chain.h.

  const LightTable& lights() const { return context_->scene->lights(); }
  float choice_ratio(uint32_t light_index, const LightReceiver& from) const {
    const float by_emission = lights().emission_probability(light_index);
    return by_emission > 0 ? lights().probability(light_index, from, options_->lights) / by_emission : 1;
  }
  void weigh_light_samples_of_light_hits() {
    for (int i = 0; i < light.hit_count(); ++i) {
      if (!light.bsdf(i).has_non_delta_lobe()) continue;
      const scene::SurfacePoint& point = light.point(i);
      const LightReceiver receiver(point.position, transport::receiver_normal(point, light.wo(i)));
      const uint32_t light_index = start_lights_[static_cast<size_t>(light.path_at(i))];
      light_vertices_[static_cast<size_t>(i)].connection *= light_rule().power(choice_ratio(light_index, receiver));
    }
  }
  // r^beta of a camera subpath that has hit a light at `vertex`. A light in direct view is sampled by light subpaths.
  float light_sample_power(uint32_t light_index, const transport::PathState<Color>& path,
                           const MisVertex& vertex) const {
    if (!chooses_by_receiver_ || camera.length() == 1 || vertex.connection == 0) return 1;
    return camera_rule().power(choice_ratio(light_index, path.receiver()));
  }
  // The sum of the camera side of a light sample.
  float relative_to_light_sample(float sum, const LightSample& sample) const {
    if (!chooses_by_receiver_) return sum;
    return MisRule::product(sum, camera_rule().power(lights().emission_probability(sample.light) / sample.choice));
  }

  const Technique& technique(int path) const { return techniques_[static_cast<size_t>(path)]; }
  MisRule light_rule() const { return {options_->heuristic, MisRule::Side::light, merge_density_}; }
  MisRule camera_rule() const { return {options_->heuristic, MisRule::Side::camera, merge_density_}; }

  static int sample_vertex_count(uint32_t bits, float& inverse_probability) {
    constexpr float kTermination = 0.35f;
    const auto more = static_cast<int>(std::log1p(-to_unit_float(bits)) / std::log1p(-kTermination));
    inverse_probability /= kTermination * std::pow(1 - kTermination, static_cast<float>(more));
    return more;
  }

  // Camera directions have the density of the image's pixels.
  void set_lens_directions() {
    for (int i = 0; i < camera.hit_count(); ++i) {
      const auto& state = camera.state_at(i);
      const Vec3 direction = -camera.wo(i);
      const float distance = glm::distance(state.from, camera.point(i).position);
      const float density =
          context_->camera->pixels_per_area(direction, distance, state.time) * sqr(distance) / pixels_;
      camera_chains_[static_cast<size_t>(camera.path_at(i))].sample_direction(
          density, context_->camera->cosine(direction, state.time));
    }
  }

  void store_camera_vertices() {
    const auto length = static_cast<size_t>(camera.length());
    if (camera_history_.size() < length) camera_history_.resize(length);
    for (int i = 0; i < camera.hit_count(); ++i)
      camera_history_[length - 1][static_cast<size_t>(camera.path_at(i))] = camera_vertices_[static_cast<size_t>(i)];
  }

  static void add_hits(PathWavefront& paths, PerPath<MisChain>& chains, PerHit& vertices, const MisRule& rule) {
    for (int i = 0; i < paths.hit_count(); ++i) {
      const scene::SurfacePoint& point = paths.point(i);
      const Vec3 edge = point.position - paths.state_at(i).from;
      vertices[static_cast<size_t>(i)] = chains[static_cast<size_t>(paths.path_at(i))].add_vertex(
          rule, length_squared(edge), cosine(point, paths.wo(i)), paths.survival(paths.path_at(i)));
    }
  }

  // `reverse_pdf` is the density of the direction to the previous vertex, as sampled from the other side; not used for
  // deltas.
  void scatter(PathWavefront& paths, PerPath<MisChain>& chains, const PerHit& vertices, const MisRule& rule, int i,
               const LobeSample<Color>& s, float reverse_pdf) const {
    const float cos_o = cosine(paths.point(i), paths.wo(i)), cos_i = cosine(paths.point(i), s.wi);
    MisChain& chain = chains[static_cast<size_t>(paths.path_at(i))];
    chain.scatter(rule, vertices[static_cast<size_t>(i)], s.delta ? cos_o : reverse_pdf, s.delta,
                  can_merge(paths.point(i), paths.bsdf(i)));
    chain.sample_direction(s.delta ? cos_i : s.pdf_solid_angle, cos_i);
  }

  // Density of an emitted direction of a triangle, per solid angle.
  float emission_direction_density(const Start& start, const Vec3& wi) const {
    const Emission& e = start.emission;
    return context_->scene->lights().emission_density(e.light, glm::dot(start.point->ng, wi), e.time).second;
  }

  bool is_enabled(int s, int t) const { return !options_->excluded.contains(s, t); }

  // The MIS sum of the light side, whose last vertex is v_j. `stored` is the last stored vertex; `v` itself need not be
  // stored yet.
  float light_sum(const MisVertex& v, int j, const Vertex* stored, float reverse_pdf, float previous_reverse_pdf, int t,
                  bool mergeable) const {
    if (options_->excluded.empty()) return v.sum(light_rule(), reverse_pdf, previous_reverse_pdf, mergeable);
    const auto vertex = [&](int k) -> const MisVertex& {
      if (k == j) return v;
      const Vertex* at = stored;
      while (at->length > k) at = at->previous;
      return at->mis;
    };
    return transport::sum_of_terms(light_rule(), j, reverse_pdf, previous_reverse_pdf, vertex,
                                   [&](int s) { return is_enabled(s, j + 1 + t - s); });
  }

  float camera_sum(int path, const MisVertex& v, int j, float reverse_pdf, float previous_reverse_pdf, int s,
                   bool mergeable) const {
    if (options_->excluded.empty()) return v.sum(camera_rule(), reverse_pdf, previous_reverse_pdf, mergeable);
    const auto vertex = [&](int k) -> const MisVertex& {
      return k == j ? v : camera_history_[static_cast<size_t>(k - 1)][static_cast<size_t>(path)];
    };
    return transport::sum_of_terms(camera_rule(), j, reverse_pdf, previous_reverse_pdf, vertex,
                                   [&](int t) { return is_enabled(j + 1 + s - t, t); });
  }

  float weight(int path, int s, int t, float light_side, float camera_side) const {
    if (!contributes(path, s, t)) return 0;
    const float inverse_probability = options_->reuse ? 1 : inverse_probability_[static_cast<size_t>(path)];
    return options_->apply_mis ? inverse_probability * MisRule::weight(options_->heuristic, light_side, camera_side)
                               : inverse_probability;
  }

  // The weight of a technique with a connection, for which the sums of both sides hold if no flight collides on it.
  Weight weight_of_connection(int path, int s, int t, float light_side, float camera_side) const {
    if constexpr (M::kScattering) {
      const bool maximum = options_->heuristic == transport::MisHeuristic::maximum;
      const float others = maximum ? std::max(light_side, camera_side) : light_side + camera_side;
      return {weight(path, s, t, 0, 0), options_->apply_mis ? others : 0, options_->heuristic};
    } else {
      return weight(path, s, t, light_side, camera_side);
    }
  }

  const RenderContext* context_ = nullptr;
  const BidirectionalOptions* options_ = nullptr;
  std::span<const Technique> techniques_;             // the only techniques of each path; empty: all
  std::array<Technique, kPaths> sampled_techniques_;  // without reuse
  PerPath<float> inverse_probability_;                // of the sampled technique
  float pixels_ = 1;                                  // area of the image in pixels
  const guiding::RadianceGuide* guide_ = nullptr;     // null: directions are not guided
  float merge_density_ = 0;                           // 0 if vertices are not merged
  bool chooses_by_receiver_ = false;                  // the choice of light samples depends on the receiver
  PerPath<uint32_t> start_lights_;                    // of the light subpaths
  VertexPool<M> pool_;
  PerPath<const Vertex*> last_light_vertex_;
  PerPath<MisChain> light_chains_, camera_chains_;
  PerHit light_vertices_, camera_vertices_;         // of the current hits
  GuidedPerHit light_guided_, camera_guided_;       // of the current hits
  std::vector<PerPath<MisVertex>> camera_history_;  // camera vertices by length, if techniques are excluded
};

}  // namespace etendue::integrator
