// Bidirectional samples of a block of pixels: the subpaths from the lights, those from the camera, and their
// connections.                                                          [Lang, sec. 9.3, eq. 9.78-9.110, corrected]
#pragma once
#include "integrator/bdpt/light_vertices.h"
#include "integrator/bdpt/techniques.h"
#include "integrator/pssmlt/primary_sample_paths.h"
#include "integrator/shared/light_path_estimators.h"
#include "transport/mis/mis.h"
#include "transport/mis/mis_chain.h"
#include "transport/path_expression/class_join.h"

namespace etendue::integrator {

// The parameters of the integrator, shared by all blocks.
struct BidirectionalOptions {
  transport::MisHeuristic heuristic;
  int max_depth, roulette_start;
  Techniques excluded, shown;
  bool apply_mis, reuse;
  std::optional<transport::ClassJoin> classes;

  bool too_long(int edges) const { return max_depth > 0 && edges > max_depth; }
  bool contributes(int s, int t) const { return !excluded.contains(s, t) && (shown.empty() || shown.contains(s, t)); }
};

template <class M>
class BidirectionalSampler {
 public:
  using PathWavefront = transport::PathWavefront<M>;
  using Color = typename M::Color;
  using Start = typename LightSubpaths<M>::Start;
  // Size of a block: fewer paths than a wavefront can hold, so that their data stays in the caches.
  static constexpr int kWidth = 16, kHeight = 16;

  std::optional<uint64_t> sample(const RenderContext& context, const BidirectionalOptions& options,
                                 const PixelBlock& block, std::span<Rgb> radiance, const TaskContext& task_context) {
    context_ = &context;
    options_ = &options;
    techniques_ = {};
    pixels_ = static_cast<float>(context.width) * static_cast<float>(context.height);
    const PixelOrder order(block);
    Splatter splatter(context, task_context, 1 / pixels_);
    if (!options.reuse) sample_techniques(block, order);
    const auto path_number = [&](int i) {
      return static_cast<uint32_t>((block.y + order.y(i)) * context_->width + block.x + order.x(i));
    };
    light_subpaths_.launch(context, block.sample, order.size(), task_context, light_, path_number,
                           [&](const Start& start, Vec2 lens) {
                             start_light_subpath(start, lens, splatter);
                             return techniques_.empty() || technique(start.path).s > 1;
                           });
    trace_light_subpaths(splatter);
    if (light_.cancelled()) return {};
    // Both subpaths of a sample have the same time.
    launch_camera_paths(context, block, order, task_context, camera_, light_subpaths_.times());
    trace_camera_subpaths();
    const auto rays = collect(camera_, order, radiance);
    if (!rays) return {};
    return *rays + light_.rays_traced() + connection_rays_ + splatter.finish();
  }

  // Evaluates given points of primary sample space, kWidth x kHeight at most: appends the contribution of each path,
  // divided by the density of its numbers, to its list of splats. The mean over uniformly distributed points is the
  // image.
  std::optional<uint64_t> evaluate(const RenderContext& context, const BidirectionalOptions& options,
                                   const PrimarySamplePaths& primary, std::span<film::Splats> splats,
                                   const TaskContext& task_context) {
    context_ = &context;
    options_ = &options;
    techniques_ = primary.techniques;
    pixels_ = ImagePlane(context).area();
    Splatter splatter(context, splats);
    light_.begin(*context.scene, *primary.light, 0, task_context.keep_going, context.model->moving);
    for (const uint32_t seed : primary.seeds) light_.add(seed ^ (primary.light_salt & ~primary.light->lane_mask()));
    light_subpaths_.launch_added(
        context, light_,
        [&](const Start& start, Vec2 lens) {
          start_light_subpath(start, lens, splatter);
          return techniques_.empty() || technique(start.path).s > 1;
        },
        [&](int path) { return needs_light(path); });
    trace_light_subpaths(splatter);
    if (light_.cancelled()) return {};
    std::array<Vec2, kPaths> rasters;
    launch_primary_sample_paths(
        context, primary, task_context, camera_, rasters,
        [&](int i) { return techniques_.empty() || technique(i).t > 1; }, light_subpaths_.times());
    trace_camera_subpaths();
    if (camera_.cancelled()) return {};
    for (int i = 0; i < camera_.size(); ++i) {
      if (!techniques_.empty() && technique(i).t < 2) continue;
      if (!is_black(camera_.state(i).radiance))
        splatter.add(i, rasters[static_cast<size_t>(i)], camera_.opacity_seed(i), camera_.state(i).radiance * pixels_);
    }
    return camera_.rays_traced() + light_.rays_traced() + connection_rays_ + splatter.finish();
  }

 private:
  using MisVertex = transport::MisVertex;
  using MisChain = transport::MisChain;
  using MisRule = transport::MisRule;
  using Vertex = LightVertex<M>;
  static constexpr size_t kPaths = size_t{kWidth} * kHeight;
  static constexpr size_t kHitsAtATime = PathWavefront::kHitsAtATime;
  template <class T>
  using PerPath = std::array<T, kPaths>;

  MisRule light_rule() const { return {options_->heuristic, MisRule::Side::light}; }
  MisRule camera_rule() const { return {options_->heuristic, MisRule::Side::camera}; }

  // Without reuse, each path is one connection of the ends of two subpaths. The numbers of vertices are sampled from
  // geometric distributions, so that every technique has a positive probability.    [Lang, sec. 9.3.1, eq. 9.36-9.75,
  // corrected]
  void sample_techniques(const PixelBlock& block, const PixelOrder& order) {
    const int least = context_->camera->can_be_hit() ? 0 : 1;
    for (int i = 0; i < order.size(); ++i) {
      const uint32_t half_buffer = block.sample % film::kHalfBuffers;
      const uint32_t seed = pixel_seed(context_->seed, block.x + order.x(i), block.y + order.y(i), half_buffer);
      const uint32_t first = mix_bits(path_seed(seed, block.sample) + 0x2545f491U);
      const auto path = static_cast<size_t>(i);
      inverse_probability_[path] = 1;
      sampled_techniques_[path] = {sample_vertex_count(first, inverse_probability_[path]),
                                   least + sample_vertex_count(mix_bits(first), inverse_probability_[path])};
    }
    techniques_ = {sampled_techniques_.data(), static_cast<size_t>(order.size())};
  }

  static int sample_vertex_count(uint32_t bits, float& inverse_probability) {
    constexpr float kTermination = 0.35f;
    const auto more = static_cast<int>(std::log1p(-to_unit_float(bits)) / std::log1p(-kTermination));
    inverse_probability /= kTermination * std::pow(1 - kTermination, static_cast<float>(more));
    return more;
  }

  // Whether a technique of the path starts on a light that is sampled with the path's own random numbers.
  bool needs_light(int path) const {
    if (techniques_.empty()) return true;
    const Technique& t = technique(path);
    return t.s > 1 || (t.s == 1 && t.t == 1);
  }

  // ---- Subpaths from the lights.

  // Traces the launched subpaths.
  void trace_light_subpaths(Splatter& splatter) {
    pool_.clear();
    last_light_vertex_.fill(nullptr);
    const MisRule rule = light_rule();
    while (light_.trace()) {
      if (context_->camera->can_be_hit())
        add_lens_hits_of_misses(*context_, light_subpaths_, light_, splatter,
                                [&](int path, const CameraRays::LensHit& hit) { return lens_hit_weight(path, hit); });
      while (light_.next_hits()) {
        if (context_->camera->can_be_hit())
          add_lens_hits_of_segments(
              *context_, light_subpaths_, light_, splatter,
              [&](int path, const CameraRays::LensHit& hit) { return lens_hit_weight(path, hit); });
        if (light_.length() == 1) light_subpaths_.apply_range_window(light_);
        add_mis_vertices(light_, light_chains_, rule);
        if (options_->too_long(light_.length() + 1)) continue;
        connect_to_camera(
            *context_, light_subpaths_, light_, splatter,
            [&](int i, const CameraRays::View& view) { return camera_connection_weight(i, view); },
            [&](int i) { return contributes(light_.path_at(i), light_.length() + 1, 1); });
        store_light_vertices();
        transport::sample_bsdf_where(
            light_, options_->roulette_start, TransportMode::importance,
            [&](int i) { return techniques_.empty() || light_.length() + 1 < technique(light_.path_at(i)).s; },
            [&](int i, const auto& s) { record_scattering(light_, light_chains_, rule, i, s); });
      }
    }
  }

  void start_light_subpath(const Start& start, Vec2 lens, Splatter& splatter) {
    const Emission& e = start.emission;
    MisChain& chain = light_chains_[static_cast<size_t>(start.path)];
    chain.start(e.density.first, !e.density.delta, e.density.infinite);
    chain.sample_direction(e.density.second, start.point ? std::abs(glm::dot(start.point->ng, e.direction)) : 1.0f);
    if (options_->too_long(1) || !contributes(start.path, 1, 1)) return;
    connect_light_to_camera<M>(
        *context_, start, lens, light_.opacity_seed(start.path), splatter,
        [&](float pixels, const Vec3& wi, float distance) { return light_view_weight(start, pixels, wi, distance); });
  }

  // The MIS weight of the directly visible light: (1, 1).
  float light_view_weight(const Start& start, float pixels, const Vec3& wi, float distance) const {
    const EmissionDensity& light = start.emission.density;
    const float hit_ratio = is_enabled(0, 2) ? light_rule().ratio(pixels / pixels_ / light.first) : 0;
    float lens_ratio = 0;
    if (context_->camera->can_be_hit() && is_enabled(2, 0)) {
      const float cosine = context_->camera->cosine(-wi, start.emission.time), area = context_->camera->lens_area();
      lens_ratio =
          light.infinite ? light.second * cosine : emission_direction_density(start, wi) * cosine / sqr(distance);
      lens_ratio = camera_rule().ratio(lens_ratio * area);
    }
    return weight(start.path, 1, 1, hit_ratio, lens_ratio);
  }

  // Density of an emitted direction of a triangle, per solid angle.
  float emission_direction_density(const Start& start, const Vec3& wi) const {
    const Emission& e = start.emission;
    return context_->scene->lights().emission_density(e.light, glm::dot(start.point->ng, wi), e.time).second;
  }

  // The subpath hit the lens: t = 0.
  float lens_hit_weight(int path, const CameraRays::LensHit& hit) {
    const int s = light_.length() + 1;
    if (options_->too_long(light_.length()) || !contributes(path, s, 0)) return 0;
    MisChain chain = light_chains_[static_cast<size_t>(path)];
    const MisVertex on_lens = chain.add_vertex(light_rule(), sqr(hit.distance), hit.cosine);
    const float sum = light_sum(on_lens, s - 1, last_light_vertex_[static_cast<size_t>(path)],
                                1 / context_->camera->lens_area(), hit.density / pixels_, 0);
    return weight(path, s, 0, sum, 0);
  }

  // The vertex is connected to the camera: t = 1.
  float camera_connection_weight(int i, const CameraRays::View& view) {
    const int s = light_.length() + 1, path = light_.path_at(i);
    const scene::SurfacePoint& point = light_.point(i);
    const Bsdf<M>& bsdf = light_.bsdf(i);
    const Vec3& wo = light_.wo(i);
    const float cosine = std::abs(glm::dot(point.ng, view.wi));
    const float lights =
        light_sum(light_vertices_[static_cast<size_t>(i)], s - 1, last_light_vertex_[static_cast<size_t>(path)],
                  view.importance * cosine / pixels_, bsdf.pdf(view.wi, wo), 1);
    float lens = 0;
    if (context_->camera->can_be_hit() && is_enabled(s + 1, 0)) {
      const float distance = view.distance, c = context_->camera->cosine(-view.wi, light_.state_at(i).time);
      lens = camera_rule().ratio(bsdf.pdf(wo, view.wi) * c / sqr(distance) * context_->camera->lens_area());
    }
    return weight(path, s, 1, lights, lens);
  }

  void store_light_vertices() {
    for (int i = 0; i < light_.hit_count(); ++i) {
      if (!light_.bsdf(i).has_non_delta_lobe()) {
        // Specular vertices cannot be connected; they are stored only where the MIS sum needs single terms.
        if (options_->excluded.empty()) continue;
      }
      const int path = light_.path_at(i);
      if (!techniques_.empty() && technique(path).s != light_.length() + 1) continue;
      const Vertex*& last = last_light_vertex_[static_cast<size_t>(path)];
      Vertex& v = pool_.add();
      v.point = light_.point(i);
      v.bsdf = light_.bsdf(i);
      v.wo = light_.wo(i);
      v.bsdf.rebind(v.point.shading, v.point.ng);
      v.flux = light_.state(path).throughput * light_subpaths_.flux(path);
      v.mis = light_vertices_[static_cast<size_t>(i)];
      v.length = light_.length();
      v.previous = last;
      if constexpr (M::kClasses) light_.shares().copy(path, v.shares);
      last = &v;
    }
  }

  // ---- Subpaths from the camera.

  // Traces the launched subpaths.
  void trace_camera_subpaths() {
    connection_rays_ = 0;
    for (int i = 0; i < camera_.size(); ++i) {
      MisChain& chain = camera_chains_[static_cast<size_t>(i)];
      const bool lens_can_be_hit = context_->camera->can_be_hit();
      chain.start(lens_can_be_hit ? 1 / context_->camera->lens_area() : 1, lens_can_be_hit, false);
    }
    const MisRule rule = camera_rule();
    while (camera_.trace()) {
      transport::add_environment_weighted(camera_, [&](int i) { return environment_weight(i); });
      while (camera_.next_hits()) {
        if (camera_.length() == 1) set_lens_directions();
        add_mis_vertices(camera_, camera_chains_, rule);
        if (!options_->excluded.empty()) store_camera_vertices();
        transport::add_emission_weighted(camera_, [&](int i) { return emission_weight(i); });
        if (options_->too_long(camera_.length() + 1)) continue;
        transport::add_direct_light_weighted(
            camera_, transport::Shadows::cast,
            [&](int i, const LightSample& light, const auto& value) {
              return light_sample_weight(i, light, value.pdf);
            },
            [&](int i) { return contributes(camera_.path_at(i), 1, camera_.length() + 1); });
        connect_vertices();
        transport::sample_bsdf_where(
            camera_, options_->roulette_start, TransportMode::radiance,
            [&](int i) { return techniques_.empty() || camera_.length() + 1 < technique(camera_.path_at(i)).t; },
            [&](int i, const auto& s) { record_scattering(camera_, camera_chains_, rule, i, s); });
      }
    }
    trace_connections();
  }

  // Camera directions have the density of the image's pixels.
  void set_lens_directions() {
    for (int i = 0; i < camera_.hit_count(); ++i) {
      const auto& state = camera_.state_at(i);
      const Vec3 direction = -camera_.wo(i);
      const float distance = glm::distance(state.from, camera_.point(i).position);
      const float density =
          context_->camera->pixels_per_area(direction, distance, state.time) * sqr(distance) / pixels_;
      camera_chains_[static_cast<size_t>(camera_.path_at(i))].sample_direction(
          density, context_->camera->cosine(direction, state.time));
    }
  }

  void store_camera_vertices() {
    const auto length = static_cast<size_t>(camera_.length());
    if (camera_history_.size() < length) camera_history_.resize(length);
    for (int i = 0; i < camera_.hit_count(); ++i)
      camera_history_[length - 1][static_cast<size_t>(camera_.path_at(i))] = camera_vertices_[static_cast<size_t>(i)];
  }

  float emission_weight(int i) {
    const int t = camera_.length() + 1, path = camera_.path_at(i);
    if (options_->too_long(t - 1) || !contributes(path, 0, t)) return 0;
    const scene::SurfacePoint& point = camera_.point(i);
    const uint32_t light = context_->scene->light_at(point);
    if (light == scene::InstanceData::kNotALight) return weight(path, 0, t, 0, 0);
    const auto d =
        context_->scene->lights().emission_density(light, glm::dot(point.ng, camera_.wo(i)), camera_.state_at(i).time);
    return weight(path, 0, t, 0,
                  camera_sum(path, camera_vertices_[static_cast<size_t>(i)], t - 1, d.first, d.second, 0));
  }

  float environment_weight(int i) {
    const int t = camera_.length() + 1, path = camera_.path_of_miss(i);
    if (options_->too_long(t - 1) || !contributes(path, 0, t)) return 0;
    const Vec3& direction = camera_.miss_direction(i);
    const auto d = context_->scene->lights().environment_emission_density(direction);
    MisChain chain = camera_chains_[static_cast<size_t>(path)];
    if (camera_.length() == 1) {
      // A direct view of the environment: (1, 1) is the only other technique.
      const float pixels = context_->camera->pixels_per_area(direction, 1, camera_.missed_path(i).time) / pixels_;
      const bool seen = context_->camera->sees_environment() && is_enabled(1, 1);
      return weight(path, 0, t, 0, seen && pixels > 0 ? camera_rule().ratio(d.first / pixels) : 0.0f);
    }
    const MisVertex at_infinity = chain.add_vertex_at_infinity(camera_rule());
    return weight(path, 0, t, 0, camera_sum(path, at_infinity, t - 1, d.first, d.second, 0));
  }

  // The MIS weight divided by the density of the sample.
  float light_sample_weight(int i, const LightSample& light, float pdf) {
    const int t = camera_.length() + 1, path = camera_.path_at(i);
    const scene::SurfacePoint& point = camera_.point(i);
    const float cosine = std::abs(glm::dot(point.ng, light.wi));
    const EmissionDensity d = context_->scene->lights().emission_density(light, camera_.state_at(i).time);
    const float hits = light.delta || !is_enabled(0, t + 1) ? 0.0f : light_rule().ratio(pdf / light.pdf);
    const float reverse_pdf = d.second * (d.infinite ? cosine : cosine / sqr(light.distance));
    const float cameras = camera_sum(path, camera_vertices_[static_cast<size_t>(i)], t - 1, reverse_pdf,
                                     camera_.bsdf(i).pdf(light.wi, camera_.wo(i)), 1);
    return weight(path, 1, t, hits, cameras) / light.pdf;
  }

  // Connects every light vertex to the current camera vertices.
  void connect_vertices() {
    for (int i = 0; i < camera_.hit_count(); ++i) {
      if (!camera_.bsdf(i).has_non_delta_lobe()) continue;
      for (const Vertex* v = last_light_vertex_[static_cast<size_t>(camera_.path_at(i))]; v; v = v->previous)
        if (v->bsdf.has_non_delta_lobe() && !options_->too_long(v->length + camera_.length() + 1)) connect(i, *v);
    }
  }

  void connect(int i, const Vertex& y) {
    const int s = y.length + 1, t = camera_.length() + 1, path = camera_.path_at(i);
    if (!contributes(path, s, t)) return;
    const scene::SurfacePoint& z = camera_.point(i);
    const Vec3 to_y = y.point.position - z.position;
    const float squared = length_squared(to_y);
    if (!(squared > 0)) return;
    const float distance = std::sqrt(squared), over_distance = 1 / distance;
    const Vec3 wi = to_y * over_distance;
    const auto at_z = camera_.bsdf(i).evaluate(camera_.wo(i), wi, TransportMode::radiance);
    if (is_black(at_z.f_cos)) return;
    const auto at_y = y.bsdf.evaluate(y.wo, -wi, TransportMode::importance);
    if (is_black(at_y.f_cos)) return;
    const float to_area = sqr(over_distance);
    const float lights =
        light_sum(y.mis, s - 1, &y, at_z.pdf * std::abs(glm::dot(y.point.ng, wi)) * to_area, y.bsdf.pdf(-wi, y.wo), t);
    const float cameras =
        camera_sum(path, camera_vertices_[static_cast<size_t>(i)], t - 1,
                   at_y.pdf * std::abs(glm::dot(z.ng, wi)) * to_area, camera_.bsdf(i).pdf(wi, camera_.wo(i)), s);
    const float w = weight(path, s, t, lights, cameras);
    if (w == 0) return;
    auto& state = camera_.state(path);
    Color value = state.throughput * at_z.f_cos * at_y.f_cos * y.flux * (w * to_area);
    value *= transport::transmittance<M>(z, wi, distance);
    if constexpr (M::kClasses) value *= class_share(i, y, wi);
    if (is_black(value)) return;
    const uint32_t seed = camera_.opacity_seed(path) + static_cast<uint32_t>(64 * s + t);
    Connection& connection = connections_.add(ray_to(z, wi, distance), state.time, seed);
    connection.path = static_cast<uint16_t>(path);
    connection.value = value;
    if (connections_.full()) trace_connections();
  }

  // The share of a connection that belongs to the selected path classes.
  Color class_share(int i, const Vertex& y, const Vec3& wi) {
    camera_.shares().copy(camera_.path_at(i), camera_shares_);
    camera_.shares().after_connection(camera_shares_, camera_.bsdf(i), camera_.wo(i), wi, camera_shares_after_);
    light_.shares().after_connection(y.shares, y.bsdf, y.wo, -wi, light_shares_after_);
    Color sum(0);
    for (size_t r = 0; r < light_shares_after_.size(); ++r)
      for (size_t q = 0; q < camera_shares_after_.size(); ++q)
        if (options_->classes->are_compatible(static_cast<uint8_t>(q), static_cast<uint8_t>(r)))
          sum += light_shares_after_[r] * camera_shares_after_[q];
    return sum;
  }

  void trace_connections() {
    connection_rays_ += connections_.settle(*context_->scene,
                                            [this](const Connection& c) { camera_.state(c.path).radiance += c.value; });
  }

  // ---- Both kinds of subpaths.

  void add_mis_vertices(PathWavefront& paths, PerPath<MisChain>& chains, const MisRule& rule) {
    auto& mis_vertices = &paths == &light_ ? light_vertices_ : camera_vertices_;
    for (int i = 0; i < paths.hit_count(); ++i) {
      const scene::SurfacePoint& point = paths.point(i);
      const Vec3 edge = point.position - paths.state_at(i).from;
      mis_vertices[static_cast<size_t>(i)] = chains[static_cast<size_t>(paths.path_at(i))].add_vertex(
          rule, length_squared(edge), std::abs(glm::dot(point.ng, paths.wo(i))));
    }
  }

  void record_scattering(PathWavefront& paths, PerPath<MisChain>& chains, const MisRule& rule, int i,
                         const LobeSample<Color>& s) {
    auto& mis_vertices = &paths == &light_ ? light_vertices_ : camera_vertices_;
    const Vec3& ng = paths.point(i).ng;
    const float cos_o = std::abs(glm::dot(ng, paths.wo(i))), cos_i = std::abs(glm::dot(ng, s.wi));
    MisChain& chain = chains[static_cast<size_t>(paths.path_at(i))];
    chain.scatter(rule, mis_vertices[static_cast<size_t>(i)], s.delta ? cos_o : paths.bsdf(i).pdf(s.wi, paths.wo(i)),
                  s.delta);
    chain.sample_direction(s.delta ? cos_i : s.pdf_solid_angle, cos_i);
  }

  // ---- Weights.

  bool is_enabled(int s, int t) const { return !options_->excluded.contains(s, t); }

  // The MIS sum of the light side, whose last vertex is v_j. `stored` is the last stored vertex; `v` itself need not be
  // stored yet.
  float light_sum(const MisVertex& v, int j, const Vertex* stored, float reverse_pdf, float previous_reverse_pdf,
                  int t) const {
    if (options_->excluded.empty()) return v.sum(light_rule(), reverse_pdf, previous_reverse_pdf);
    const auto vertex = [&](int k) -> const MisVertex& {
      if (k == j) return v;
      const Vertex* at = stored;
      while (at->length > k) at = at->previous;
      return at->mis;
    };
    return transport::sum_of_terms(light_rule(), j, reverse_pdf, previous_reverse_pdf, vertex,
                                   [&](int s) { return is_enabled(s, j + 1 + t - s); });
  }

  float camera_sum(int path, const MisVertex& v, int j, float reverse_pdf, float previous_reverse_pdf, int s) const {
    if (options_->excluded.empty()) return v.sum(camera_rule(), reverse_pdf, previous_reverse_pdf);
    const auto vertex = [&](int k) -> const MisVertex& {
      return k == j ? v : camera_history_[static_cast<size_t>(k - 1)][static_cast<size_t>(path)];
    };
    return transport::sum_of_terms(camera_rule(), j, reverse_pdf, previous_reverse_pdf, vertex,
                                   [&](int t) { return is_enabled(j + 1 + s - t, t); });
  }

  const Technique& technique(int path) const { return techniques_[static_cast<size_t>(path)]; }
  bool contributes(int path, int s, int t) const {
    if (!techniques_.empty() && (technique(path).s != s || technique(path).t != t)) return false;
    return options_->contributes(s, t);
  }

  float weight(int path, int s, int t, float light, float camera) const {
    if (!contributes(path, s, t)) return 0;
    const float inverse_probability = options_->reuse ? 1 : inverse_probability_[static_cast<size_t>(path)];
    return options_->apply_mis ? inverse_probability * MisRule::weight(options_->heuristic, light, camera)
                               : inverse_probability;
  }

  struct Connection {
    uint16_t path;
    Color value;
  };

  const RenderContext* context_ = nullptr;
  const BidirectionalOptions* options_ = nullptr;
  std::span<const Technique> techniques_;             // the only technique of each path; empty: all
  std::array<Technique, kPaths> sampled_techniques_;  // without reuse
  PerPath<float> inverse_probability_;                // of the sampled technique
  float pixels_ = 1;                                  // number of pixels of the image
  PathWavefront light_, camera_;
  LightSubpaths<M> light_subpaths_;
  VertexPool<M> pool_;
  PerPath<const Vertex*> last_light_vertex_;
  PerPath<MisChain> light_chains_, camera_chains_;
  std::array<MisVertex, kHitsAtATime> light_vertices_, camera_vertices_;  // of the current hits
  std::vector<PerPath<MisVertex>> camera_history_;  // camera vertices by length, if techniques are excluded
  transport::Connections<Connection> connections_;
  uint64_t connection_rays_ = 0;
  std::vector<Color> camera_shares_, camera_shares_after_, light_shares_after_;
};

}  // namespace etendue::integrator
