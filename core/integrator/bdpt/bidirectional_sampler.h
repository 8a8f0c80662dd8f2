// A block of bidirectional samples: the walks from the lights, those from the camera, and what lies between them.
#pragma once
#include "integrator/bdpt/light_vertices.h"
#include "integrator/bdpt/techniques.h"
#include "integrator/pssmlt/primary_sample_paths.h"
#include "integrator/shared/light_path_estimators.h"
#include "transport/mis/mis.h"
#include "transport/mis/mis_chain.h"
#include "transport/path_expression/class_join.h"

namespace etendue::integrator {

// What all blocks of a picture share.
struct BidirectionalOptions {
  transport::MisHeuristic heuristic;
  int max_depth, roulette_start;
  Techniques without, only;
  bool weighted, reuse;
  std::optional<transport::ClassJoin> classes;

  bool too_long(int edges) const { return max_depth > 0 && edges > max_depth; }
  bool counts(int s, int t) const { return !without.contains(s, t) && (only.empty() || only.contains(s, t)); }
};

template <class M>
class BidirectionalSampler {
 public:
  using PathWavefront = transport::PathWavefront<M>;
  using Color = typename M::Color;
  using Start = typename LightSubpaths<M>::Start;
  // Walks that go side by side: fewer than a front holds, so that what is kept of them stays near the processor.
  static constexpr int kWidth = 16, kHeight = 16;

  std::optional<uint64_t> sample(const RenderContext& context, const BidirectionalOptions& plan,
                                 const PixelBlock& block, std::span<Rgb> radiance, const TaskContext& task_context) {
    context_ = &context, plan_ = &plan, techniques_ = {};
    pixels_ = static_cast<float>(context.width) * static_cast<float>(context.height);
    const PixelOrder order(block);
    Splatter splatter(context, task_context, 1 / pixels_);
    if (!plan.reuse) draw_ends(block, order);
    const auto number_of = [&](int i) {
      return static_cast<uint32_t>((block.y + order.y(i)) * context_->width + block.x + order.x(i));
    };
    walks_.launch(context, block.sample, order.size(), task_context, light_, number_of,
                  [&](const Start& start, Vec2 lens) {
                    begin_light(start, lens, splatter);
                    return techniques_.empty() || technique(start.path).s > 1;
                  });
    shoot(splatter);
    if (light_.cancelled()) return {};
    // What is to be connected must be there at one time.
    launch_camera_paths(context, block, order, task_context, camera_, walks_.times());
    gather();
    const auto rays = collect(camera_, order, radiance);
    if (!rays) return {};
    return *rays + light_.rays_traced() + connection_rays_ + splatter.finish();
  }

  // What paths of these numbers, kWidth x kHeight at most, bring to the picture, each with the density that its numbers
  // have: where all of them are equally likely, the mean over many is the picture.
  std::optional<uint64_t> evaluate(const RenderContext& context, const BidirectionalOptions& plan,
                                   const PrimarySamplePaths& given, std::span<film::Splats> found,
                                   const TaskContext& task_context) {
    context_ = &context, plan_ = &plan, techniques_ = given.techniques;
    pixels_ = Plane(context).area();
    Splatter splatter(context, found);
    light_.begin(*context.scene, *given.light, 0, task_context.keep_going, context.model->moving);
    for (const uint32_t seed : given.seeds) light_.add(seed ^ (given.light_salt & ~given.light->lane_mask()));
    walks_.launch_added(
        context, light_,
        [&](const Start& start, Vec2 lens) {
          begin_light(start, lens, splatter);
          return techniques_.empty() || technique(start.path).s > 1;
        },
        [&](int path) { return needs_light(path); });
    shoot(splatter);
    if (light_.cancelled()) return {};
    std::array<Vec2, kPaths> rasters;
    launch_primary_sample_paths(
        context, given, task_context, camera_, rasters,
        [&](int i) { return techniques_.empty() || technique(i).t > 1; }, walks_.times());
    gather();
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

  MisRule light_rule() const { return {plan_->heuristic, MisRule::Side::light}; }
  MisRule camera_rule() const { return {plan_->heuristic, MisRule::Side::camera}; }

  // Without reuse each path is a connection of two ends alone. The numbers of vertices are geometric, so that every
  // technique has its turn; it then counts for the others of its kind that have none.   thesis 9.3.1, (9.36)-(9.75)
  void draw_ends(const PixelBlock& block, const PixelOrder& order) {
    const int least = context_->camera->can_be_hit() ? 0 : 1;
    for (int i = 0; i < order.size(); ++i) {
      const uint32_t half_buffer = block.sample % film::kHalfBuffers;
      const uint32_t seed = pixel_seed(context_->seed, block.x + order.x(i), block.y + order.y(i), half_buffer);
      const uint32_t first = mix_bits(path_seed(seed, block.sample) + 0x2545f491U);
      const auto path = static_cast<size_t>(i);
      gain_[path] = 1;
      drawn_[path] = {vertices(first, gain_[path]), least + vertices(mix_bits(first), gain_[path])};
    }
    techniques_ = {drawn_.data(), static_cast<size_t>(order.size())};
  }

  static int vertices(uint32_t bits, float& gain) {
    constexpr float kEnds = 0.35f;
    const auto more = static_cast<int>(std::log1p(-to_unit_float(bits)) / std::log1p(-kEnds));
    gain /= kEnds * std::pow(1 - kEnds, static_cast<float>(more));
    return more;
  }

  // Whether any technique of the path begins with a vertex on a light that its own numbers choose.
  bool needs_light(int path) const {
    if (techniques_.empty()) return true;
    const Technique& t = technique(path);
    return t.s > 1 || (t.s == 1 && t.t == 1);
  }

  // ---- Walks from the lights.

  // Walks that were launched.
  void shoot(Splatter& splatter) {
    pool_.clear();
    last_.fill(nullptr);
    const MisRule rule = light_rule();
    while (light_.trace()) {
      if (context_->camera->can_be_hit())
        escape_through_lens(*context_, walks_, light_, splatter,
                            [&](int path, const CameraRays::LensHit& a) { return weight_on_lens(path, a); });
      while (light_.next_hits()) {
        if (context_->camera->can_be_hit())
          pass_through_lens(*context_, walks_, light_, splatter,
                            [&](int path, const CameraRays::LensHit& a) { return weight_on_lens(path, a); });
        if (light_.length() == 1) walks_.dim_first_vertices(light_);
        note_arrivals(light_, light_chains_, rule);
        if (plan_->too_long(light_.length() + 1)) continue;
        connect_to_camera(
            *context_, walks_, light_, splatter,
            [&](int i, const CameraRays::View& view) { return weight_to_camera(i, view); },
            [&](int i) { return counts(light_.path_at(i), light_.length() + 1, 1); });
        keep_vertices();
        transport::sample_bsdf_where(
            light_, plan_->roulette_start, TransportMode::importance,
            [&](int i) { return techniques_.empty() || light_.length() + 1 < technique(light_.path_at(i)).s; },
            [&](int i, const auto& s) { note_scatter(light_, light_chains_, rule, i, s); });
      }
    }
  }

  void begin_light(const Start& start, Vec2 lens, Splatter& splatter) {
    const Emission& e = start.emission;
    MisChain& chain = light_chains_[static_cast<size_t>(start.path)];
    chain.start(e.density.first, !e.density.delta, e.density.infinite);
    chain.leave(e.density.second, start.point ? std::abs(glm::dot(start.point->ng, e.direction)) : 1.0f);
    if (plan_->too_long(1) || !counts(start.path, 1, 1)) return;
    see_light<M>(
        *context_, start, lens, light_.opacity_seed(start.path), splatter,
        [&](float pixels, const Vec3& wi, float distance) { return weight_of_view(start, pixels, wi, distance); });
  }

  // The light itself is seen by the camera: (1, 1).
  float weight_of_view(const Start& start, float pixels, const Vec3& wi, float distance) const {
    const EmissionDensity& light = start.emission.density;
    const float hit = possible(0, 2) ? light_rule().ratio(pixels / pixels_ / light.first) : 0;
    float fall = 0;
    if (context_->camera->can_be_hit() && possible(2, 0)) {
      const float cosine = context_->camera->cosine(-wi, start.emission.time), area = context_->camera->lens_area();
      fall = light.infinite ? light.second * cosine : side_density(start, wi) * cosine / sqr(distance);
      fall = camera_rule().ratio(fall * area);
    }
    return weight(start.path, 1, 1, hit, fall);
  }

  // Of a direction in which a triangle shines, per solid angle.
  float side_density(const Start& start, const Vec3& wi) const {
    const Emission& e = start.emission;
    return context_->scene->lights().emission_density(e.light, glm::dot(start.point->ng, wi), e.time).second;
  }

  // The walk fell onto the lens: t = 0.
  float weight_on_lens(int path, const CameraRays::LensHit& a) {
    const int s = light_.length() + 1;
    if (plan_->too_long(light_.length()) || !counts(path, s, 0)) return 0;
    MisChain chain = light_chains_[static_cast<size_t>(path)];
    const MisVertex on_lens = chain.arrive(light_rule(), sqr(a.distance), a.cosine);
    const float sum = light_sum(on_lens, s - 1, last_[static_cast<size_t>(path)], 1 / context_->camera->lens_area(),
                                a.density / pixels_, 0);
    return weight(path, s, 0, sum, 0);
  }

  // The vertex is seen by the camera: t = 1.
  float weight_to_camera(int i, const CameraRays::View& view) {
    const int s = light_.length() + 1, path = light_.path_at(i);
    const scene::SurfacePoint& point = light_.point(i);
    const Bsdf<M>& bsdf = light_.bsdf(i);
    const Vec3& wo = light_.wo(i);
    const float cosine = std::abs(glm::dot(point.ng, view.wi));
    const float lights = light_sum(light_vertices_[static_cast<size_t>(i)], s - 1, last_[static_cast<size_t>(path)],
                                   view.importance * cosine / pixels_, bsdf.pdf(view.wi, wo), 1);
    float lens = 0;
    if (context_->camera->can_be_hit() && possible(s + 1, 0)) {
      const float distance = view.distance, c = context_->camera->cosine(-view.wi, light_.state_at(i).time);
      lens = camera_rule().ratio(bsdf.pdf(wo, view.wi) * c / sqr(distance) * context_->camera->lens_area());
    }
    return weight(path, s, 1, lights, lens);
  }

  void keep_vertices() {
    for (int i = 0; i < light_.hit_count(); ++i) {
      if (!light_.bsdf(i).has_non_delta_lobe()) {
        // What cannot be connected still belongs to the densities of what comes after.
        if (plan_->without.empty()) continue;
      }
      const int path = light_.path_at(i);
      if (!techniques_.empty() && technique(path).s != light_.length() + 1) continue;
      const Vertex*& last = last_[static_cast<size_t>(path)];
      Vertex& v = pool_.add();
      v.point = light_.point(i), v.bsdf = light_.bsdf(i), v.wo = light_.wo(i);
      v.bsdf.rebind(v.point.shading, v.point.ng);
      v.flux = light_.state(path).throughput * walks_.flux(path);
      v.mis = light_vertices_[static_cast<size_t>(i)];
      v.length = light_.length(), v.before = last;
      if constexpr (M::kClasses) light_.shares().copy(path, v.shares);
      last = &v;
    }
  }

  // ---- Walks from the camera.

  // Walks that were launched.
  void gather() {
    connection_rays_ = 0;
    for (int i = 0; i < camera_.size(); ++i) {
      MisChain& chain = camera_chains_[static_cast<size_t>(i)];
      const bool hit = context_->camera->can_be_hit();
      chain.start(hit ? 1 / context_->camera->lens_area() : 1, hit, false);
    }
    const MisRule rule = camera_rule();
    while (camera_.trace()) {
      transport::add_environment_weighted(camera_, [&](int i) { return weight_of_escape(i); });
      while (camera_.next_hits()) {
        if (camera_.length() == 1) leave_lens();
        note_arrivals(camera_, camera_chains_, rule);
        if (!plan_->without.empty()) remember_camera_vertices();
        transport::add_emission_weighted(camera_, [&](int i) { return weight_of_emission(i); });
        if (plan_->too_long(camera_.length() + 1)) continue;
        transport::add_direct_light_weighted(
            camera_, transport::Shadows::cast,
            [&](int i, const LightSample& light, const auto& value) { return weight_of_light(i, light, value.pdf); },
            [&](int i) { return counts(camera_.path_at(i), 1, camera_.length() + 1); });
        connect_vertices();
        transport::sample_bsdf_where(
            camera_, plan_->roulette_start, TransportMode::radiance,
            [&](int i) { return techniques_.empty() || camera_.length() + 1 < technique(camera_.path_at(i)).t; },
            [&](int i, const auto& s) { note_scatter(camera_, camera_chains_, rule, i, s); });
      }
    }
    settle();
  }

  // Directions through the lens have the density of the picture's pixels.
  void leave_lens() {
    for (int i = 0; i < camera_.hit_count(); ++i) {
      const auto& state = camera_.state_at(i);
      const Vec3 direction = -camera_.wo(i);
      const float distance = glm::distance(state.from, camera_.point(i).position);
      const float density =
          context_->camera->pixels_per_area(direction, distance, state.time) * sqr(distance) / pixels_;
      camera_chains_[static_cast<size_t>(camera_.path_at(i))].leave(density,
                                                                    context_->camera->cosine(direction, state.time));
    }
  }

  void remember_camera_vertices() {
    const auto length = static_cast<size_t>(camera_.length());
    if (history_.size() < length) history_.resize(length);
    for (int i = 0; i < camera_.hit_count(); ++i)
      history_[length - 1][static_cast<size_t>(camera_.path_at(i))] = camera_vertices_[static_cast<size_t>(i)];
  }

  float weight_of_emission(int i) {
    const int t = camera_.length() + 1, path = camera_.path_at(i);
    if (plan_->too_long(t - 1) || !counts(path, 0, t)) return 0;
    const scene::SurfacePoint& point = camera_.point(i);
    const uint32_t light = context_->scene->light_at(point);
    if (light == scene::InstanceData::kNotALight) return weight(path, 0, t, 0, 0);
    const auto d =
        context_->scene->lights().emission_density(light, glm::dot(point.ng, camera_.wo(i)), camera_.state_at(i).time);
    return weight(path, 0, t, 0,
                  camera_sum(path, camera_vertices_[static_cast<size_t>(i)], t - 1, d.first, d.second, 0));
  }

  float weight_of_escape(int i) {
    const int t = camera_.length() + 1, path = camera_.path_of_miss(i);
    if (plan_->too_long(t - 1) || !counts(path, 0, t)) return 0;
    const Vec3& direction = camera_.miss_direction(i);
    const auto d = context_->scene->lights().environment_emission_density(direction);
    MisChain chain = camera_chains_[static_cast<size_t>(path)];
    if (camera_.length() == 1) {
      // From the lens to infinity: (1, 1) is the only other one.
      const float pixels = context_->camera->pixels_per_area(direction, 1, camera_.missed_path(i).time) / pixels_;
      const bool seen = context_->camera->sees_environment() && possible(1, 1);
      return weight(path, 0, t, 0, seen && pixels > 0 ? camera_rule().ratio(d.first / pixels) : 0.0f);
    }
    const MisVertex far = chain.arrive_at_infinity(camera_rule());
    return weight(path, 0, t, 0, camera_sum(path, far, t - 1, d.first, d.second, 0));
  }

  // A weight over the density of the sample.
  float weight_of_light(int i, const LightSample& light, float pdf) {
    const int t = camera_.length() + 1, path = camera_.path_at(i);
    const scene::SurfacePoint& point = camera_.point(i);
    const float cosine = std::abs(glm::dot(point.ng, light.wi));
    const EmissionDensity d = context_->scene->lights().emission_density(light, camera_.state_at(i).time);
    const float hits = light.delta || !possible(0, t + 1) ? 0.0f : light_rule().ratio(pdf / light.pdf);
    const float back = d.second * (d.infinite ? cosine : cosine / sqr(light.distance));
    const float cameras = camera_sum(path, camera_vertices_[static_cast<size_t>(i)], t - 1, back,
                                     camera_.bsdf(i).pdf(light.wi, camera_.wo(i)), 1);
    return weight(path, 1, t, hits, cameras) / light.pdf;
  }

  // Every vertex of the walk from the light with the present one of the camera's.
  void connect_vertices() {
    for (int i = 0; i < camera_.hit_count(); ++i) {
      if (!camera_.bsdf(i).has_non_delta_lobe()) continue;
      for (const Vertex* v = last_[static_cast<size_t>(camera_.path_at(i))]; v; v = v->before)
        if (v->bsdf.has_non_delta_lobe() && !plan_->too_long(v->length + camera_.length() + 1)) connect(i, *v);
    }
  }

  void connect(int i, const Vertex& y) {
    const int s = y.length + 1, t = camera_.length() + 1, path = camera_.path_at(i);
    if (!counts(path, s, t)) return;
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
    if constexpr (M::kClasses) value *= share(i, y, wi);
    if (is_black(value)) return;
    const uint32_t seed = camera_.opacity_seed(path) + static_cast<uint32_t>(64 * s + t);
    Connected& connected =
        connections_.add(ray_to(z, wi, distance), state.time, seed, camera_.medium_beyond(i, wi), distance);
    connected.path = static_cast<uint16_t>(path);
    connected.value = value;
    if (connections_.full()) settle();
  }

  // Of the connection, what belongs to the classes that are asked for.
  Color share(int i, const Vertex& y, const Vec3& wi) {
    camera_.shares().copy(camera_.path_at(i), row_);
    camera_.shares().connected(row_, camera_.bsdf(i), camera_.wo(i), wi, at_camera_);
    light_.shares().connected(y.shares, y.bsdf, y.wo, -wi, at_light_);
    Color sum(0);
    for (size_t r = 0; r < at_light_.size(); ++r)
      for (size_t q = 0; q < at_camera_.size(); ++q)
        if (plan_->classes->go_together(static_cast<uint8_t>(q), static_cast<uint8_t>(r)))
          sum += at_light_[r] * at_camera_[q];
    return sum;
  }

  void settle() {
    connection_rays_ += connections_.settle(*context_->scene, [this](const Connected& c, const Rgb& transmittance) {
      camera_.state(c.path).radiance += c.value * transmittance;
    });
  }

  // ---- Of either kind.

  void note_arrivals(PathWavefront& paths, PerPath<MisChain>& chains, const MisRule& rule) {
    auto& vertices = &paths == &light_ ? light_vertices_ : camera_vertices_;
    for (int i = 0; i < paths.hit_count(); ++i) {
      const scene::SurfacePoint& point = paths.point(i);
      const Vec3 edge = point.position - paths.state_at(i).from;
      vertices[static_cast<size_t>(i)] = chains[static_cast<size_t>(paths.path_at(i))].arrive(
          rule, length_squared(edge), std::abs(glm::dot(point.ng, paths.wo(i))));
    }
  }

  void note_scatter(PathWavefront& paths, PerPath<MisChain>& chains, const MisRule& rule, int i,
                    const LobeSample<Color>& s) {
    auto& vertices = &paths == &light_ ? light_vertices_ : camera_vertices_;
    const Vec3& ng = paths.point(i).ng;
    const float cos_o = std::abs(glm::dot(ng, paths.wo(i))), cos_i = std::abs(glm::dot(ng, s.wi));
    MisChain& chain = chains[static_cast<size_t>(paths.path_at(i))];
    chain.scatter(rule, vertices[static_cast<size_t>(i)], s.delta ? cos_o : paths.bsdf(i).pdf(s.wi, paths.wo(i)),
                  s.delta);
    chain.leave(s.delta ? cos_i : s.pdf_solid_angle, cos_i);
  }

  // ---- Weights.

  bool possible(int s, int t) const { return !plan_->without.contains(s, t); }

  // S of the light's side, whose last vertex is v_j (not yet kept if `kept` is the one before it).
  float light_sum(const MisVertex& v, int j, const Vertex* kept, float back, float further_back, int t) const {
    if (plan_->without.empty()) return v.sum(light_rule(), back, further_back);
    const auto vertex = [&](int k) -> const MisVertex& {
      if (k == j) return v;
      const Vertex* at = kept;
      while (at->length > k) at = at->before;
      return at->mis;
    };
    return transport::sum_of_terms(light_rule(), j, back, further_back, vertex,
                                   [&](int s) { return possible(s, j + 1 + t - s); });
  }

  float camera_sum(int path, const MisVertex& v, int j, float back, float further_back, int s) const {
    if (plan_->without.empty()) return v.sum(camera_rule(), back, further_back);
    const auto vertex = [&](int k) -> const MisVertex& {
      return k == j ? v : history_[static_cast<size_t>(k - 1)][static_cast<size_t>(path)];
    };
    return transport::sum_of_terms(camera_rule(), j, back, further_back, vertex,
                                   [&](int t) { return possible(j + 1 + s - t, t); });
  }

  const Technique& technique(int path) const { return techniques_[static_cast<size_t>(path)]; }
  bool counts(int path, int s, int t) const {
    if (!techniques_.empty() && (technique(path).s != s || technique(path).t != t)) return false;
    return plan_->counts(s, t);
  }

  float weight(int path, int s, int t, float light, float camera) const {
    if (!counts(path, s, t)) return 0;
    const float gain = plan_->reuse ? 1 : gain_[static_cast<size_t>(path)];
    return plan_->weighted ? gain * MisRule::weight(plan_->heuristic, light, camera) : gain;
  }

  struct Connected {
    uint16_t path;
    Color value;
  };

  const RenderContext* context_ = nullptr;
  const BidirectionalOptions* plan_ = nullptr;
  std::span<const Technique> techniques_;  // that each path is found by alone; empty: all
  std::array<Technique, kPaths> drawn_;    // where ends alone are connected
  PerPath<float> gain_;                    // one over the probability of drawing them
  float pixels_ = 1;                       // of the picture
  PathWavefront light_, camera_;
  LightSubpaths<M> walks_;
  VertexPool<M> pool_;
  PerPath<const Vertex*> last_;
  PerPath<MisChain> light_chains_, camera_chains_;
  std::array<MisVertex, kHitsAtATime> light_vertices_, camera_vertices_;  // of the present arrivals
  std::vector<PerPath<MisVertex>> history_;  // the camera's vertices by length, where techniques are left out
  transport::Connections<Connected> connections_;
  uint64_t connection_rays_ = 0;
  std::vector<Color> row_, at_camera_, at_light_;
};

}  // namespace etendue::integrator
