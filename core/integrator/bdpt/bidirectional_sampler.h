// Bidirectional samples of a block of pixels: traces both subpaths and connects their vertices.
//                                                                       [Lang, sec. 9.3, eq. 9.78-9.110, corrected]
#pragma once
#include <limits>

#include "integrator/bdpt/bidirectional_subpaths.h"
#include "integrator/guiding/guided_render_state.h"
#include "integrator/guiding/guided_sampling.h"
#include "integrator/pssmlt/primary_sample_paths.h"

namespace etendue::integrator {

template <class M>
class BidirectionalSampler {
 public:
  using PathWavefront = transport::PathWavefront<M>;
  using Color = typename M::Color;
  using Start = typename LightSubpaths<M>::Start;
  static constexpr int kWidth = BidirectionalSubpaths<M>::kWidth, kHeight = BidirectionalSubpaths<M>::kHeight;

  // `guided`: camera subpaths are guided, and recorded; not in scattering media.
  std::optional<uint64_t> sample(const RenderContext& context, const BidirectionalOptions& options,
                                 const PixelBlock& block, std::span<Rgb> radiance, const TaskContext& task_context,
                                 const guiding::GuidedBlock* guided = nullptr) {
    context_ = &context;
    options_ = &options;
    const float pixels = static_cast<float>(context.width) * static_cast<float>(context.height);
    subpaths_.begin(context, options, {}, pixels, guided ? &guided->guide : nullptr);
    const PixelOrder order(block);
    Splatter splatter(context, task_context, 1 / pixels);
    if (!options.reuse) subpaths_.sample_techniques(block, order);
    const auto path_number = [&](int i) {
      return static_cast<uint32_t>((block.y + order.y(i)) * context_->width + block.x + order.x(i));
    };
    light_starts_.launch(context, block.sample, order.size(), task_context, subpaths_.light, path_number,
                         [&](const Start& start, Vec2 lens) { return start_light_subpath(start, lens, splatter); });
    trace_light_subpaths(splatter);
    if (subpaths_.light.cancelled()) return {};
    // Both subpaths of a sample have the same time.
    launch_camera_paths(context, block, order, task_context, subpaths_.camera, light_starts_.times());
    if constexpr (M::kScattering)
      trace_camera_subpaths();
    else if (guided)
      trace_guided_subpaths(*guided);
    else
      trace_camera_subpaths();
    const auto rays = collect(subpaths_.camera, order, radiance);
    if (!rays) return {};
    return *rays + subpaths_.light.rays_traced() + connection_rays_ + splatter.finish();
  }

  // Traces the light subpaths of a sample with the numbers `first` and so on, of which sample() traces one per pixel.
  // vertex(subpaths, starts, i) is called for each current hit i of `subpaths.light` that can be merged.
  template <class OnVertex>
  std::optional<uint64_t> trace_light_paths(const RenderContext& context, const BidirectionalOptions& options,
                                            uint32_t sample, int first, int count, const TaskContext& task_context,
                                            OnVertex&& vertex) {
    context_ = &context;
    options_ = &options;
    subpaths_.begin(context, options, {}, static_cast<float>(context.width) * static_cast<float>(context.height));
    light_starts_.launch(
        context, sample, count, task_context, subpaths_.light, [&](int i) { return static_cast<uint32_t>(first + i); },
        [&](const Start& start, Vec2) {
          subpaths_.start_light(start);
          return true;
        });
    PathWavefront& light = subpaths_.light;
    while (light.trace())
      while (light.next_hits()) {
        if (light.length() == 1) light_starts_.apply_range_window(light);
        subpaths_.add_light_hits();
        if (options.too_long(light.length() + 1)) continue;
        vertex(subpaths_, light_starts_);
        transport::sample_bsdf_where(
            light, options.roulette_start, TransportMode::importance, [](int) { return true; },
            [&](int i, const auto& s) { subpaths_.scatter_light(i, s); });
      }
    if (light.cancelled()) return {};
    return light.rays_traced();
  }

  // Evaluates given points of primary sample space, kWidth x kHeight at most: appends the contribution of each path,
  // divided by the density of its numbers, to its list of splats. The mean over uniformly distributed points is the
  // image.
  std::optional<uint64_t> evaluate(const RenderContext& context, const BidirectionalOptions& options,
                                   const PrimarySamplePaths& primary, std::span<film::Splats> splats,
                                   const TaskContext& task_context) {
    context_ = &context;
    options_ = &options;
    const float pixels = ImagePlane(context).area();
    subpaths_.begin(context, options, primary.techniques, pixels);
    Splatter splatter(context, splats);
    subpaths_.light.begin(*context.scene, *primary.light, 0, task_context.keep_going, context.model->moving);
    for (const uint32_t seed : primary.seeds)
      subpaths_.light.add(seed ^ (primary.light_salt & ~primary.light->lane_mask()));
    light_starts_.launch_added(
        context, subpaths_.light,
        [&](const Start& start, Vec2 lens) { return start_light_subpath(start, lens, splatter); },
        [&](int path) { return subpaths_.needs_light(path); });
    trace_light_subpaths(splatter);
    if (subpaths_.light.cancelled()) return {};
    std::array<Vec2, BidirectionalSubpaths<M>::kPaths> rasters;
    launch_primary_sample_paths(
        context, primary, task_context, subpaths_.camera, rasters,
        [&](int i) { return subpaths_.has_camera_subpath(i); }, light_starts_.times());
    trace_camera_subpaths();
    if (subpaths_.camera.cancelled()) return {};
    for (int i = 0; i < subpaths_.camera.size(); ++i) {
      if (!subpaths_.has_camera_subpath(i)) continue;
      if (!is_black(subpaths_.camera.state(i).radiance))
        splatter.add(i, rasters[static_cast<size_t>(i)], subpaths_.camera.opacity_seed(i),
                     subpaths_.camera.state(i).radiance * pixels);
    }
    return subpaths_.camera.rays_traced() + subpaths_.light.rays_traced() + connection_rays_ + splatter.finish();
  }

 private:
  using Vertex = LightVertex<M>;

  // ---- Subpaths from the lights.

  // Traces the launched subpaths.
  void trace_light_subpaths(Splatter& splatter) {
    subpaths_.clear_light_vertices();
    const auto lens_weight = [&](int path, const CameraRays::LensHit& hit, float survival) {
      return subpaths_.lens_hit_weight(path, hit, survival);
    };
    while (subpaths_.light.trace()) {
      if (context_->camera->can_be_hit())
        add_lens_hits_of_misses(*context_, light_starts_, subpaths_.light, splatter, lens_weight);
      while (subpaths_.light.next_hits()) {
        if (context_->camera->can_be_hit())
          add_lens_hits_of_segments(*context_, light_starts_, subpaths_.light, splatter, lens_weight);
        if (subpaths_.light.length() == 1) light_starts_.apply_range_window(subpaths_.light);
        subpaths_.add_light_hits();
        if (options_->too_long(subpaths_.light.length() + 1)) continue;
        connect_to_camera(
            *context_, light_starts_, subpaths_.light, splatter,
            [&](int i, const CameraRays::View& view) { return subpaths_.camera_connection_weight(i, view); },
            [&](int i) { return subpaths_.contributes(subpaths_.light.path_at(i), subpaths_.light.length() + 1, 1); });
        subpaths_.store_light_vertices(light_starts_);
        transport::sample_bsdf_where(
            subpaths_.light, options_->roulette_start, TransportMode::importance,
            [&](int i) { return subpaths_.continues_from_light(i); },
            [&](int i, const auto& s) { subpaths_.scatter_light(i, s); });
      }
    }
  }

  // Starts a light subpath and adds the directly visible light. Returns whether further vertices are needed.
  bool start_light_subpath(const Start& start, Vec2 lens, Splatter& splatter) {
    subpaths_.start_light(start);
    if (!options_->too_long(1) && subpaths_.contributes(start.path, 1, 1))
      connect_light_to_camera<M>(*context_, start, lens, subpaths_.light.opacity_seed(start.path), splatter,
                                 [&](float pixels, const Vec3& wi, float distance) {
                                   return subpaths_.light_view_weight(start, pixels, wi, distance);
                                 });
    return subpaths_.has_light_subpath(start.path);
  }

  // ---- Subpaths from the camera.

  struct MediumTechniques {
    const BidirectionalSubpaths<M>* subpaths;
    transport::TechniqueWeight emission(int path) const { return subpaths->medium_technique(path, 0); }
    transport::TechniqueWeight light_sample(int path) const { return subpaths->medium_technique(path, 1); }
  };

  // Traces the launched subpaths. begin_segment() is called when they have been traced to their next vertices;
  // scatter() samples the directions of the current hits.
  template <class BeginSegment, class Scatter>
  void trace_camera_subpaths(BeginSegment&& begin_segment, Scatter&& scatter) {
    connection_rays_ = 0;
    subpaths_.start_camera();
    transport::MediumLight<M, MediumTechniques> media(subpaths_.camera, options_->heuristic, {&subpaths_});
    while (subpaths_.camera.trace()) {
      begin_segment();
      media.add_emission_of_misses();
      transport::add_environment_weighted(subpaths_.camera, [&](int i) { return subpaths_.environment_weight(i); });
      while (subpaths_.camera.next_hits()) {
        media.add_emission_before_hits();
        subpaths_.add_camera_hits();
        transport::add_emission_weighted(subpaths_.camera, [&](int i) { return subpaths_.emission_weight(i); });
        if (options_->too_long(subpaths_.camera.length() + 1)) continue;
        transport::add_direct_light_weighted(
            subpaths_.camera, options_->lights, transport::Shadows::cast,
            [&](int i, const LightSample& light, const auto& value) {
              return subpaths_.light_sample_weight(i, light, value.pdf);
            },
            [&](int i) {
              return subpaths_.contributes(subpaths_.camera.path_at(i), 1, subpaths_.camera.length() + 1);
            });
        media.add_light_samples();
        connect_vertices();
        if (options_->merges) merge_vertices();
        scatter();
      }
    }
    trace_connections();
  }

  void trace_camera_subpaths() {
    trace_camera_subpaths([] {},
                          [&] {
                            transport::sample_bsdf_where(
                                subpaths_.camera, options_->roulette_start, TransportMode::radiance,
                                [&](int i) { return subpaths_.continues_from_camera(i); },
                                [&](int i, const auto& s) { subpaths_.scatter_camera(i, s); });
                          });
  }

  // The weights of all techniques contain the density of guided directions, which must be the same at all vertices of a
  // path. So all vertices are guided, not only the first ones.
  void trace_guided_subpaths(const guiding::GuidedBlock& block) {
    constexpr guiding::GuidingOptions kAllVertices{.vertices = std::numeric_limits<int>::max()};
    guiding::GuidedSampling<M> guided(subpaths_.camera, block.guide, records_, kAllVertices);
    records_.begin(block.recorded_share);
    trace_camera_subpaths(
        [&] {
          // The connections of the last vertices belong to these vertices, as their light samples do.
          trace_connections();
          records_.separate_direct_light(subpaths_.camera);
        },
        [&] {
          guided.begin_hits();
          guided.sample_directions(options_->roulette_start,
                                   [&](int i, const auto& s) { subpaths_.scatter_camera(i, s); });
        });
    records_.collect(subpaths_.camera, block.guide, [&](const guiding::Record& r) { block.records.push_back(r); });
  }

  // Connects every light vertex to the current camera vertices.
  void connect_vertices() {
    for (int i = 0; i < subpaths_.camera.hit_count(); ++i) {
      if (!subpaths_.camera.bsdf(i).has_non_delta_lobe()) continue;
      for (const Vertex* v = subpaths_.last_light_vertex(subpaths_.camera.path_at(i)); v; v = v->previous)
        if (v->bsdf.has_non_delta_lobe() && !options_->too_long(v->length + subpaths_.camera.length() + 1))
          connect(i, *v);
    }
  }

  void connect(int i, const Vertex& y) {
    const int s = y.length + 1, t = subpaths_.camera.length() + 1, path = subpaths_.camera.path_at(i);
    if (!subpaths_.contributes(path, s, t)) return;
    const scene::SurfacePoint& z = subpaths_.camera.point(i);
    const Vec3 to_y = y.point.position - z.position;
    const float squared = length_squared(to_y);
    if (!(squared > 0)) return;
    const float distance = std::sqrt(squared), over_distance = 1 / distance;
    const Vec3 wi = to_y * over_distance;
    const auto at_z = subpaths_.camera.bsdf(i).evaluate(subpaths_.camera.wo(i), wi, TransportMode::radiance);
    if (is_black(at_z.f_cos)) return;
    const auto at_y = y.bsdf.evaluate(y.wo, -wi, TransportMode::importance);
    if (is_black(at_y.f_cos)) return;
    const float to_area = sqr(over_distance);
    const float pdf_at_z = subpaths_.camera_pdf(i, wi, at_z.pdf);
    const auto weight = subpaths_.connection_weight(i, y, wi, pdf_at_z * subpaths_.cosine(y.point, wi) * to_area,
                                                    at_y.pdf * subpaths_.cosine(z, wi) * to_area);
    const float w = transport::known_factor(weight);
    if (w == 0) return;
    auto& state = subpaths_.camera.state(path);
    Color value = state.throughput * at_z.f_cos * at_y.f_cos * y.flux * (w * to_area);
    if constexpr (M::kClasses) value *= class_share(i, y, wi);
    if (is_black(value)) return;
    const uint32_t seed = subpaths_.camera.opacity_seed(path) + static_cast<uint32_t>(64 * s + t);
    Connection& connection = connections_.add(ray_to(z, wi, distance), state.time, seed,
                                              subpaths_.camera.medium_beyond(i, wi), distance, weight);
    connection.path = static_cast<uint16_t>(path);
    connection.value = value;
    if (connections_.full()) trace_connections();
  }

  // Merges the current camera vertices with the stored light vertices around them.
  void merge_vertices() {
    for (int i = 0; i < subpaths_.camera.hit_count(); ++i) {
      const scene::SurfacePoint& z = subpaths_.camera.point(i);
      if (!subpaths_.can_merge(z, subpaths_.camera.bsdf(i))) continue;
      if constexpr (M::kClasses) subpaths_.camera.shares().copy(subpaths_.camera.path_at(i), camera_shares_);
      Color sum(0);
      options_->merges->for_each_near(z.position, z.ng, [&](const MergeVertex& y) { sum += merged(i, y); });
      auto& state = subpaths_.camera.state_at(i);
      state.radiance += state.throughput * sum * options_->merges->normalization();
    }
  }

  // The flux of a light vertex that camera vertex i reflects, weighted. The density of light vertices follows the
  // geometric surface, the BSDF the shading normal; the ratio of cosines is bounded, as for photons.
  Color merged(int i, const MergeVertex& y) {
    constexpr float kMinCosine = 1e-3f;
    if (options_->too_long(y.length + subpaths_.camera.length())) return Color(0);
    const auto at_z = subpaths_.camera.bsdf(i).evaluate(subpaths_.camera.wo(i), y.wo, TransportMode::radiance);
    if (is_black(at_z.f_cos)) return Color(0);
    const float cosine = std::max(subpaths_.cosine(subpaths_.camera.point(i), y.wo), kMinCosine);
    Color value = at_z.f_cos * y.flux * (subpaths_.merge_weight(i, y, at_z.pdf) / cosine);
    if constexpr (M::kClasses) value *= class_share(i, y);
    return value;
  }

  // The share of a merge that belongs to the selected path classes. `camera_shares_` are those at camera vertex i.
  Color class_share(int i, const MergeVertex& y) {
    subpaths_.camera.shares().after_connection(camera_shares_, subpaths_.camera.bsdf(i), subpaths_.camera.wo(i), y.wo,
                                               camera_shares_after_);
    Color sum(0);
    for (size_t q = 0; q < camera_shares_after_.size(); ++q)
      if (options_->classes->are_compatible(static_cast<uint8_t>(q), y.state)) sum += camera_shares_after_[q];
    return sum;
  }

  // The share of a connection that belongs to the selected path classes.
  Color class_share(int i, const Vertex& y, const Vec3& wi) {
    subpaths_.camera.shares().copy(subpaths_.camera.path_at(i), camera_shares_);
    subpaths_.camera.shares().after_connection(camera_shares_, subpaths_.camera.bsdf(i), subpaths_.camera.wo(i), wi,
                                               camera_shares_after_);
    subpaths_.light.shares().after_connection(y.shares, y.bsdf, y.wo, -wi, light_shares_after_);
    Color sum(0);
    for (size_t r = 0; r < light_shares_after_.size(); ++r)
      for (size_t q = 0; q < camera_shares_after_.size(); ++q)
        if (options_->classes->are_compatible(static_cast<uint8_t>(q), static_cast<uint8_t>(r)))
          sum += light_shares_after_[r] * camera_shares_after_[q];
    return sum;
  }

  void trace_connections() {
    connection_rays_ += connections_.settle(*context_->scene, [this](const Connection& c, const Rgb& transmittance) {
      subpaths_.camera.state(c.path).radiance += c.value * transmittance;
    });
  }

  struct Connection {
    uint16_t path;
    Color value;
  };

  const RenderContext* context_ = nullptr;
  const BidirectionalOptions* options_ = nullptr;
  BidirectionalSubpaths<M> subpaths_;
  LightSubpaths<M> light_starts_;
  transport::Connections<Connection> connections_;
  guiding::PathRecords<M> records_;  // of guided subpaths
  uint64_t connection_rays_ = 0;
  std::vector<Color> camera_shares_, camera_shares_after_, light_shares_after_;
};

// The sampler of the calling thread.
template <class M>
BidirectionalSampler<M>& thread_sampler() {
  static thread_local const auto sampler = std::make_unique<BidirectionalSampler<M>>();
  return *sampler;
}

// Samples a block in pieces of the size of the sampler.
template <class M>
std::optional<uint64_t> sample_in_pieces(const RenderContext& context, const BidirectionalOptions& options,
                                         const PixelBlock& block, std::span<Rgb> radiance,
                                         const TaskContext& task_context,
                                         const guiding::GuidedBlock* guided = nullptr) {
  using BlockSampler = BidirectionalSampler<M>;
  std::array<Rgb, size_t{BlockSampler::kWidth} * BlockSampler::kHeight> part;
  uint64_t rays = 0;
  for (int top = 0; top < block.height; top += BlockSampler::kHeight)
    for (int left = 0; left < block.width; left += BlockSampler::kWidth) {
      const PixelBlock piece{block.x + left, block.y + top, std::min(BlockSampler::kWidth, block.width - left),
                             std::min(BlockSampler::kHeight, block.height - top), block.sample};
      const auto traced = thread_sampler<M>().sample(context, options, piece, part, task_context, guided);
      if (!traced) return {};
      rays += *traced;
      const Rgb* next = part.data();
      for (int y = top; y < top + piece.height; ++y)
        for (int x = left; x < left + piece.width; ++x) radiance[static_cast<size_t>(y * block.width + x)] = *next++;
    }
  return rays;
}

}  // namespace etendue::integrator
