// Guided bidirectional path tracing                         [Müller et al. 2017; Vorba et al. 2014; Veach and Guibas 1994]
//
// Bidirectional path tracing (bdpt.cpp) whose camera subpaths sample directions by a mixture of the BSDF and of the
// incident radiance that earlier samples have found, as guided path tracing does (guided_path_tracing.cpp):
//
//    p(w) = (1 - c) p_b(w) + c p_g(w)
//
// The MIS weights of all techniques contain this density wherever they contain the density of a direction of camera
// subpaths, also at vertices of light subpaths. It depends on the vertex and the two directions only, so the weights of
// a path sum to one over its techniques.
//
// The guide learns the light that camera subpaths contribute, as far as their MIS weights leave it to them: light that
// connections and light samples find well is left out. Light subpaths sample the BSDF.
//
// As in guided path tracing, a sample is guided by those before it only, all samples count alike, and different samples
// are uncorrelated.
//
//   Paths         E(D|G|S)*L; point lights: E.*(D|G)L, E(D|G).*L and E.*(D|G)(D|G).*L
//   Bias          none; Russian roulette on the light that is expected
//   Cost          that of bidirectional path tracing; 24 bytes per vertex of a camera subpath; up to some ten MB for the
//                 guide
//   Limitations   Those of bidirectional path tracing. The first samples are unguided. Each connection looks up the guide
//                 at both ends. Scattering media and wavelengths are not supported.
#include "integrator/bdpt/bidirectional_sampler.h"
#include "integrator/integrator_base.h"
#include "integrator/registration.h"
#include "integrator/shared/light_learning.h"

namespace etendue::integrator {

class GuidedBdpt final : public IntegratorBase<GuidedBdpt> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "bdpt-guided",
        .label = "Guided bidirectional path tracing",
        .summary = "Bidirectional path tracing whose camera subpaths follow the light that earlier samples have found",
        .group = Group::bidirectional,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G)L|E(D|G).*L|E.*(D|G)(D|G).*L",
        .bias = Bias::unbiased,
        .cost =
            "that of bidirectional path tracing; 24 bytes per vertex of a camera subpath, some ten MB for what is "
            "learned",
        .limitations =
            "The first samples are those of bidirectional path tracing, and each vertex costs more: it does not pay "
            "where connections find most light. Caustics seen in mirrors or through glass are found only if a subpath "
            "happens to hit the light or the lens, and never for point lights.",
        .accumulation = Accumulation::with_splats,
        .division = {DivisionUnit::none, false, "Every sample is guided by what all samples before it have found."},
        .ignores_portals = true,
    };
  }

  Choice<transport::MisHeuristic> heuristic{"heuristic", "MIS heuristic", transport::MisHeuristic::power,
                                            "How the techniques that find a path are weighted"};
  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};
  Number<float> fraction{"fraction", "Guided fraction", 0, {0, 0.95f}, guiding::kFractionDoc};

  auto parameters() { return std::tie(max_depth, heuristic, roulette_start, fraction); }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const override;
};

namespace {

class GuidedBdptState final : public guiding::GuidedRenderState {
 public:
  GuidedBdptState(const GuidedBdpt& integrator, const RenderContext& context)
      : GuidedRenderState(context, integrator.fraction),
        context_(context),
        learned_(learn_light_choice(context, LightStrategy::emission_auto, integrator.max_depth)),
        options_{.heuristic = integrator.heuristic,
                 .max_depth = integrator.max_depth,
                 .roulette_start = integrator.roulette_start,
                 .classes = class_join(*context.model),
                 .lights = LightSampling(LightStrategy::emission_auto).with(learned_.get())} {}

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    static thread_local std::vector<guiding::Record> records;
    records.clear();
    const guiding::GuidedBlock guided{guide(), recorded_share(), records};
    const auto rays = transport::with_model(*context_.model, [&]<class M>(M) {
      return sample_in_pieces<M>(context_, options_, block, radiance, task_context, &guided);
    });
    if (rays) record(block, records);
    return rays;
  }

 private:
  const RenderContext context_;
  const std::shared_ptr<const LearnedLightChoice> learned_;  // null: nothing to learn
  const BidirectionalOptions options_;
};

}  // namespace

std::unique_ptr<RenderState> GuidedBdpt::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<GuidedBdptState>(*this, context);
}

Registration guided_bdpt() { return registration<GuidedBdpt>(); }

}  // namespace etendue::integrator
