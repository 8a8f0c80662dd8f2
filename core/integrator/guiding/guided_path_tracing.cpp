// Guided path tracing                                                                   [Müller et al. 2017; Müller 2019]
//
// Path tracing whose directions are sampled by a mixture of the BSDF and of the incident radiance that earlier samples
// have found:
//
//    L  ~  sum over i  beta_i ( w_l f_s L_e |cos| V / p_l  +  w f_s L_e |cos| / p ),      p = (1 - c) p_b + c p_g
//    beta_i = product of f_s |cos| / p over the vertices before x_i
//
// The first twelve vertices of a path are guided; later ones sample the BSDF.
//
// A binary tree divides space into regions. Each region stores the distribution p_g of directions as a quadtree, and the
// fraction c. They are learned in iterations of 2, 4, 8, ... samples; each iteration is guided by the one before. Light
// that next event estimation finds is left out of what is learned, as far as its MIS weights do so.
//
// With `product`, p_g is the density of the product of incident radiance and cosine (cosine_product.h)
// [Herholz et al. 2016], which is the whole integrand where the BSDF is diffuse. Samples have less noise but take more
// time, and do not pay in the scenes that were measured (docs/results/integrators.md).
//
// Every sample is unbiased, whatever its guide is, and all samples count alike. A sample is guided by those before it
// only. Given these its expectation is the image, so different samples are uncorrelated, although they are not
// independent. The half-buffers are therefore uncorrelated too, and their difference measures the error, although both
// learn from all samples. Pixels cannot have different sample counts, because a count that depends on samples would
// depend on the guide.
//
// Russian roulette compares the light that a path is expected to find with the light that was expected at its first
// guided vertex [Vorba and Křivánek 2016], both from what was learned.
//
//   Paths         E(D|G|S)*L; point lights: E.*(D|G)L
//   Bias          none
//   Cost          two rays per vertex; 24 bytes per vertex of a sample; up to some ten MB for the guide
//   Limitations   The first samples are those of path tracing. Each vertex costs up to twice the time of path tracing,
//                 which does not pay where light sampling finds most light. Point lights behind glass are never found.
//                 Scattering media and wavelengths are not supported.
#include "integrator/guiding/guided_render_state.h"
#include "integrator/guiding/guided_sampling.h"
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"
#include "integrator/shared/light_learning.h"

namespace etendue::integrator {

class GuidedPathTracing final : public IntegratorBase<GuidedPathTracing> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "path-guided",
        .label = "Guided path tracing",
        .summary = "Path tracing whose directions follow the light that earlier samples have found",
        .group = Group::gathering,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G)L",
        .bias = Bias::unbiased,
        .cost = "2 rays per vertex; 24 bytes per vertex of a sample, some ten MB for what is learned",
        .limitations =
            "The first samples are those of path tracing, and each vertex costs more: it does not pay where light "
            "sampling finds most light. Point lights behind glass are never found.",
        .accumulation = Accumulation::per_image,
        .division = {DivisionUnit::none, false, "Every sample is guided by what all samples before it have found."},
    };
  }

  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::automatic, kLightsDoc};
  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             2,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};
  Number<float> fraction{"fraction", "Guided fraction", 0, {0, 0.95f}, guiding::kFractionDoc};

  Toggle product{
      "product", "Product with cosine", false,
      "Guides directions by the product of radiance and cosine. Off: by the radiance alone, which is faster"};

  using IntegratorBase::at_max_depth;

  auto parameters() { return std::tie(max_depth, lights, roulette_start, fraction, product); }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const final;
};

namespace {

class GuidedState final : public guiding::GuidedRenderState {
 public:
  GuidedState(const GuidedPathTracing& integrator, const RenderContext& context)
      : GuidedRenderState(context, integrator.fraction),
        integrator_(integrator),
        context_(context),
        learned_(learn_light_choice(context, light_sampling(), integrator.max_depth)) {}

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_model(*context_.model,
                                 [&]<class M>(M) { return sample_with<M>(block, radiance, task_context); });
  }

 private:
  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    static thread_local guiding::PathRecords<M> path_records;
    const PixelOrder order(block);
    launch_camera_paths(context_, block, order, task_context, paths);
    path_records.begin(recorded_share());
    estimate(paths, path_records);
    const auto rays = collect(paths, order, radiance);
    if (!rays) return {};
    static thread_local std::vector<guiding::Record> records;
    records.clear();
    path_records.collect(paths, guide(), [](const guiding::Record& record) { records.push_back(record); });
    record(block, records);
    return rays;
  }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths, guiding::PathRecords<M>& records) const {
    using namespace transport;
    constexpr MisHeuristic kHeuristic = MisHeuristic::power;
    const auto sampling = light_sampling().with(learned_.get());
    guiding::GuidedSampling<M> guided(paths, guide(), records, {.product = integrator_.product});
    while (paths.trace()) {
      records.separate_direct_light(paths);
      add_environment(paths, kHeuristic, sampling);
      while (paths.next_hits()) {
        add_emission(paths, kHeuristic, sampling);
        if (integrator_.at_max_depth(paths.length())) continue;
        guided.begin_hits();
        guided.add_direct_light(sampling);
        guided.sample_directions(integrator_.roulette_start);
      }
    }
  }

  LightSampling light_sampling() const { return LightSampling::compensated(integrator_.lights); }

  const GuidedPathTracing& integrator_;
  const RenderContext context_;
  const std::shared_ptr<const LearnedLightChoice> learned_;  // null: nothing to learn
};

}  // namespace

std::unique_ptr<RenderState> GuidedPathTracing::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<GuidedState>(*this, context);
}

Registration guided_path_tracing() { return registration<GuidedPathTracing>(); }

}  // namespace etendue::integrator
