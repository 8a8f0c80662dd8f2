// Bidirectional path tracing                         [Lang, sec. 9.3, eq. 9.78-9.110, corrected; Veach and Guibas 1994]
//
// Each sample of a pixel traces one subpath from the camera and one from the lights, and connects every vertex of the
// one with every vertex of the other [Lafortune and Willems 1993]. A path of k edges can be found by k + 2 techniques
// (s, t), with s vertices from the light and t from the camera:
//
//    s = 0   the camera subpath hits a light                  t = 0   the light subpath hits the lens
//    s = 1   a point on a light is sampled                    t = 1   the vertex is connected to the camera and
//    else    the two last vertices are connected                      contributes to any pixel
//
// Their contributions are combined by multiple importance sampling (transport/mis/mis_chain.h):
//
//    L  ~  sum over (s, t)  w_s,t f(x_s,t) / p_s,t(x_s,t),    w_s,t = p_s,t^beta / sum over i of p_i,k+1-i^beta
//
//   Paths         E(D|G|S|V)*L; point lights: E.*(D|G|V)L, E(D|G|V).*L and E.*(D|G|V)(D|G|V).*L
//   Bias          none; Russian roulette on the throughput
//   Cost          rays grow with the square of the path length; two subpaths and one image besides the film
//   Limitations   Caustics seen in mirrors or through glass are found only if a subpath happens to hit the light or the
//                 lens, and never for point lights. Inefficient if the lights are far from the visible surfaces. Light
//                 of media that emit is found by camera subpaths only.
#include "integrator/bdpt/bidirectional_sampler.h"
#include "integrator/bdpt/techniques.h"
#include "integrator/integrator_base.h"
#include "integrator/registration.h"
#include "integrator/shared/light_learning.h"
#include "transport/mis/mis.h"

namespace etendue::integrator {

Result<void> accepts_techniques(std::string_view text);

class Bdpt final : public IntegratorBase<Bdpt> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "bdpt",
        .label = "Bidirectional path tracing",
        .summary =
            "Subpaths from the camera and from the lights, with every vertex of the one connected to every vertex of "
            "the other",
        .group = Group::bidirectional,
        .paths = "E(D|G|S|V)*L",
        .point_paths = "E.*(D|G|V)L|E(D|G|V).*L|E.*(D|G|V)(D|G|V).*L",
        .bias = Bias::unbiased,
        .cost = "rays grow with the square of the path length; two subpaths and one image besides the film",
        .limitations =
            "Caustics seen in mirrors or through glass are found only if a subpath happens to hit the light or the "
            "lens, and never for point lights. Inefficient if the lights are far from the visible surfaces. Light of "
            "media that emit is found by camera subpaths only.",
        .accumulation = Accumulation::with_splats,
        .division = {DivisionUnit::samples, false,
                     "A sample depends on its pixel and its number only. Its light subpath contributes to any pixel."},
        .shortcut = '6',
        .techniques = {"without", "only", "weighted"},
        .scattering_media = true,
        .heterogeneous_media = true,
        .emitting_media = true,
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
  Text without{
      "without",
      "Excluded techniques",
      "",
      "Excludes these techniques; the remaining ones are reweighted. Pairs s,t of vertices from the light and from the "
      "camera; '1,*' is all with s = 1. Paths that no other technique finds are missing",
      accepts_techniques,
      {{"", "None"},
       {"0,*", "Hits of lights, s = 0"},
       {"1,*", "Light samples, s = 1"},
       {"*,1", "To the camera, t = 1"}}};
  Text only{"only",
            "Displayed techniques",
            "",
            "Shows the contributions of these techniques alone, with the MIS weights of all",
            accepts_techniques,
            {{"", "All"},
             {"0,*", "Hits of lights, s = 0"},
             {"1,*", "Light samples, s = 1"},
             {"*,1", "To the camera, t = 1"}}};
  Toggle reuse{"reuse", "Connect all", true,
               "Connects all pairs of vertices. Off: only the ends of the two subpaths; fewer rays, much more noise"};
  Toggle weighted{
      "weighted", "Apply MIS weights", true,
      "Off: each technique contributes in full, so that a path is counted once per technique that finds it"};

  auto parameters() { return std::tie(max_depth, heuristic, roulette_start, reuse, without, only, weighted); }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const override;
};
namespace {

Techniques parse(const std::string& text) { return *Techniques::parse(text); }

class BdptState final : public RenderState {
 public:
  BdptState(const Bdpt& integrator, const RenderContext& context)
      : context_(context),
        learned_(learn_light_choice(context, LightStrategy::emission_auto, integrator.max_depth)),
        options_{.heuristic = integrator.heuristic,
                 .max_depth = integrator.max_depth,
                 .roulette_start = integrator.roulette_start,
                 .excluded = parse(integrator.without),
                 .shown = parse(integrator.only),
                 .apply_mis = integrator.weighted,
                 .reuse = integrator.reuse,
                 .classes = class_join(*context.model),
                 .lights = LightSampling(LightStrategy::emission_auto).with(learned_.get())} {}

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_scattering_model(*context_.model, [&]<class M>(M) {
      return sample_in_pieces<M>(context_, options_, block, radiance, task_context);
    });
  }

 private:
  const RenderContext context_;
  const std::shared_ptr<const LearnedLightChoice> learned_;  // null: nothing to learn
  const BidirectionalOptions options_;
};

}  // namespace

Result<void> accepts_techniques(std::string_view text) {
  const auto parse = Techniques::parse(text);
  return parse ? Result<void>() : parse.error();
}

std::unique_ptr<RenderState> Bdpt::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<BdptState>(*this, context);
}

Registration bdpt() { return registration<Bdpt>(); }

}  // namespace etendue::integrator
