// Vertex connection and merging                                 [Georgiev et al. 2012; Lang, sec. 9.3, 9.5]
//
// Bidirectional path tracing and progressive photon mapping as techniques of one estimator. Camera subpaths are
// connected with the light subpath of their pixel, as in `bdpt`, and merged with the vertices of the light subpaths of
// all pixels within a radius r_i of a vertex:
//
//    L  ~  sum over connections  w f / p  +  1 / (pi r_i^2 N)  sum over merges  w f_s Phi
//
//    r_i+1^2 / r_i^2 = (i + alpha) / (i + 1)
//
// N is the number of light subpaths of a sample. The MIS weights contain all connections and merges that find a path
// (transport/mis/mis_chain.h). Merges find caustics seen in mirrors and through glass; connections find diffuse light
// with less noise. The bias of merges vanishes with the radius, as in `sppm`.
//
// Light subpaths are traced twice: first all of a sample, whose vertices are stored with 64 bytes each, and again with
// their pixel, because connections need the whole BSDF of a vertex. Both have the same random numbers.
//
// A merge on a nearly specular surface blurs what it reflects, where connections and BSDF samples are exact. Vertices are
// therefore merged only on surfaces that have a diffuse lobe or are rough enough. In scattering media, collisions are connected
// but not merged.
//
//   Paths         E(D|G|S|V)*L; point lights: E.*(D|G).*L, and the paths of bdpt
//   Bias          consistent
//   Cost          that of bdpt and once more its light subpaths; 64 bytes per vertex of a light subpath
//   Limitations   Simple scenes gain nothing over path tracing. Light of media that emit is found by camera subpaths
//                 only, and caustics of point lights in media seen through glass are not found. Neither are those on
//                 glossy surfaces below the roughness limit, if both light and camera see the surface by specular
//                 reflection or refraction.
#include "integrator/bdpt/bidirectional_sampler.h"
#include "integrator/integrator_base.h"
#include "integrator/photon/progressive_radius.h"
#include "integrator/registration.h"
#include "transport/path_expression/join_weights.h"

namespace etendue::integrator {

class Vcm final : public IntegratorBase<Vcm> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "vcm",
        .label = "Vertex connection and merging",
        .summary = "Bidirectional path tracing combined with photon mapping by multiple importance sampling",
        .group = Group::bidirectional,
        .paths = "E(D|G|S|V)*L",
        .point_paths = "E.*(D|G).*L|E.*(D|G|V)L|E(D|G|V).*L|E.*(D|G|V)(D|G|V).*L",
        .bias = Bias::consistent,
        .cost = "that of bdpt and once more its light subpaths; 64 bytes per vertex of a light subpath",
        .limitations =
            "Simple scenes gain nothing over path tracing. Light of media that emit is found by camera subpaths only, "
            "and caustics of point lights in media seen through glass are not found. Neither are those on glossy "
            "surfaces "
            "below the roughness limit, if both light and camera see the surface by specular reflection or refraction.",
        .accumulation = Accumulation::with_splats,
        .division = {DivisionUnit::passes, false,
                     "The light subpaths and the radius of a sample depend on its number only. They contribute to any "
                     "pixel."},
        .scattering_media = true,
        .heterogeneous_media = true,
        .emitting_media = true,
        .ignores_portals = true,
    };
  }

  Number<float> radius{
      "radius",
      "Initial radius",
      2,
      {0.001f, 1000},
      "Radius of merges in the first sample, in pixels at the distance of the scene's centre (at least "
      "the scene's radius). Raising it reduces noise and blurs light",
      "px",
      Scale::logarithmic};
  Number<float> alpha{
      "alpha",
      "Alpha (radius reduction)",
      0.75f,
      {0.01f, 1},
      "Raising it shrinks the radius more slowly: noise falls faster, bias more slowly. 1 keeps the radius constant"};
  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};

  Number<float> roughness{"roughness",
                          "Min. roughness of merges",
                          0.2f,
                          {0, 1},
                          "Surfaces that only have glossy lobes below this roughness are connected, but not merged. "
                          "Lowering it finds more caustics on them and blurs what they reflect"};

  auto parameters() { return std::tie(max_depth, radius, alpha, roulette_start, roughness); }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const override;
};
namespace {

class VcmState final : public RenderState {
 public:
  VcmState(const Vcm& integrator, const RenderContext& context)
      : integrator_(integrator),
        context_(context),
        pixel_(pixel_width(context)),
        options_{.heuristic = transport::MisHeuristic::power,
                 .max_depth = integrator.max_depth,
                 .roulette_start = integrator.roulette_start,
                 .classes = class_join(*context.model),
                 .merges = &map_,
                 .merge_split = transport::LobeSplit(integrator.roughness),
                 .lights = LightStrategy::emission_pdf} {}

  std::vector<Phase> phases(uint32_t sample) override {
    const double shrunk = std::sqrt(region_ratio(double{integrator_.alpha}, sample / film::kHalfBuffers));
    const float radius = integrator_.radius * static_cast<float>(shrunk) * pixel_;
    map_.begin(std::max(radius, kLeastRadius), light_paths());
    lists_.resize(static_cast<size_t>((light_paths() + kTask - 1) / kTask));
    return {{"tracing light paths", static_cast<int>(lists_.size())}, {"ordering vertices", MergeMap::kPieces}};
  }
  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const TaskContext& task_context) override {
    if (phase == 0)
      return transport::with_scattering_model(
          *context_.model, [&]<class M>(M) { return trace_light_paths<M>(sample, task, task_context); });
    map_.build_piece(task, lists_);
    return 0;
  }

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_scattering_model(*context_.model, [&]<class M>(M) {
      return sample_in_pieces<M>(at_shared_time(context_, block.sample), options_, block, radiance, task_context);
    });
  }

  size_t memory() const override { return map_.memory(); }

  std::shared_ptr<const std::vector<StoredPoint>> points() const override {
    auto points = std::make_shared<std::vector<StoredPoint>>();
    const size_t stride = std::max<size_t>(1, (map_.size() + kMostPoints - 1) / kMostPoints);
    const float share = 1 / static_cast<float>(light_paths());
    map_.for_some(stride, [&](const MergeVertex& v) { points->push_back({v.position, v.flux * share}); });
    return points;
  }

 private:
  static constexpr int kTask = 256;              // light subpaths
  static constexpr float kLeastRadius = 1e-12f;  // metres; the scene can be a point

  // In metres, at the distance of the scene's centre; for a camera inside of the scene, at the radius of the scene.
  static float pixel_width(const RenderContext& context) {
    const Bounds& bounds = context.scene->bounds();
    if (bounds.empty()) return 0;
    const Vec2 size(static_cast<float>(context.width), static_cast<float>(context.height));
    const Vec3 center = (bounds.min + bounds.max) * 0.5f, eye = context.camera->ray(size * 0.5f, Vec2(0.5f)).origin;
    return PixelFootprint(*context.camera, context.width, context.height)
        .over(std::max(glm::distance(eye, center), bounds.radius()));
  }

  int light_paths() const { return context_.width * context_.height; }

  template <class M>
  std::optional<uint64_t> trace_light_paths(uint32_t sample, int task, const TaskContext& task_context) {
    static_assert(kTask <= BidirectionalSubpaths<M>::kPaths);
    static thread_local std::vector<MergeVertex> found;
    found.clear();
    const int first = task * kTask;
    const auto rays = thread_sampler<M>().trace_light_paths(
        at_shared_time(context_, sample), options_, sample, first, std::min(kTask, light_paths() - first), task_context,
        [&](BidirectionalSubpaths<M>& subpaths, const LightSubpaths<M>& starts) { collect(subpaths, starts, found); });
    if (rays) map_.divide(found, lists_[static_cast<size_t>(task)]);
    return rays;
  }

  // Appends the current light vertices.
  template <class M>
  static void collect(BidirectionalSubpaths<M>& subpaths, const LightSubpaths<M>& starts,
                      std::vector<MergeVertex>& found) {
    auto& light = subpaths.light;
    if constexpr (M::kClasses) light.draw(dimensions(vertex_dimension::kLightChoice, 1));
    for (int i = 0; i < light.hit_count(); ++i) {
      const scene::SurfacePoint& point = light.point(i);
      if (!subpaths.can_merge(point, light.bsdf(i))) continue;
      const int path = light.path_at(i);
      MergeVertex v;
      v.flux = light.state(path).throughput * starts.flux(path);
      if constexpr (M::kClasses) {
        const auto drawn = transport::draw_state(light.shares(), path, light.random(vertex_dimension::kLightChoice, i));
        v.flux *= drawn.weight;
        v.state = drawn.state;
      }
      if (is_black(v.flux)) continue;
      const transport::MisVertex& mis = subpaths.light_vertex(i);
      v.position = point.position;
      v.normal = point.ng;
      v.wo = light.wo(i);
      v.pdf = mis.pdf;
      v.weighted_sum = mis.weighted_sum;
      v.connectible = mis.connection > 0;
      v.length = static_cast<uint16_t>(std::min(light.length(), 65535));
      found.push_back(v);
    }
  }

  const Vcm& integrator_;
  const RenderContext context_;
  const float pixel_;
  MergeMap map_;
  const BidirectionalOptions options_;
  std::vector<MergeMap::Lists> lists_;  // by task
};

}  // namespace

std::unique_ptr<RenderState> Vcm::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<VcmState>(*this, context);
}

Registration vcm() { return registration<Vcm>(); }

}  // namespace etendue::integrator
