// Bidirectional path tracing.             thesis 9.3, (9.78)-(9.110), errata E20-E26; Veach & Guibas 1995; Lafortune &
// Willems 1993
//
// Each sample of a pixel lets a walk go from the camera and one from the lights, and connects every vertex of the one
// with every vertex of the other: a path of k edges is found by up to k + 2 techniques (s, t), with s vertices from the
// light and t from the camera, whose contributions are weighted by their densities (transport/mis_chain.h):
//
//   s = 0   the walk from the camera meets a light           t = 0   the walk from the light falls onto the lens
//   s = 1   a point on a light is chosen anew                t = 1   the vertex is seen by the camera, anywhere in the
//   else    the two vertices see each other                          picture
#include "integrator/bdpt/bidirectional_sampler.h"
#include "integrator/bdpt/techniques.h"
#include "integrator/integrator_base.h"
#include "integrator/registration.h"
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
            "Walks from the camera and from the lights, every vertex of the one connected with every vertex of the "
            "other",
        .group = Group::bidirectional,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G)L|E(D|G).*L|E.*(D|G)(D|G).*L",
        .bias = Bias::unbiased,
        .cost = "about the square of the path's length in rays; two walks and a picture beside the film",
        .limitations =
            "caustics seen in mirrors or through glass: found by chance alone, and never if the light is a point; "
            "scenes "
            "whose lights are far from what is seen",
        .accumulation = Accumulation::with_splats,
        .shortcut = '6',
        .techniques = {"without", "only", "weighted"},
    };
  }

  Choice<transport::MisHeuristic> heuristic{"heuristic", "MIS heuristic", transport::MisHeuristic::power,
                                            "How the techniques that find a path share it"};
  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};
  Text without{
      "without",
      "Techniques left out",
      "",
      "Lets the others do the work of these: pairs s,t of vertices from the light and from the camera, '1,*' all "
      "with s = 1. What none of the others finds is missing",
      accepts_techniques,
      {{"", "None"},
       {"0,*", "Hits of lights, s = 0"},
       {"1,*", "Light samples, s = 1"},
       {"*,1", "To the camera, t = 1"}}};
  Text only{"only",
            "Techniques shown",
            "",
            "Shows what these alone find, weighted as if all were there",
            accepts_techniques,
            {{"", "All"},
             {"0,*", "Hits of lights, s = 0"},
             {"1,*", "Light samples, s = 1"},
             {"*,1", "To the camera, t = 1"}}};
  Toggle reuse{
      "reuse", "Connect all", true,
      "Off: only the ends of the two walks are connected, the basic form of thesis 9.3.1: fewer rays, much more "
      "noise"};
  Toggle weighted{"weighted", "Weighted", true,
                  "Off: each technique counts in full, so that several that find a path count it several times"};

  auto parameters() { return std::tie(max_depth, heuristic, roulette_start, reuse, without, only, weighted); }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const override;
};
namespace {

Techniques parsed(const std::string& text) { return *Techniques::parse(text); }

class Samples final : public RenderState {
 public:
  Samples(const Bdpt& method, const RenderContext& context)
      : context_(context),
        plan_{method.heuristic,
              method.max_depth,
              method.roulette_start,
              parsed(method.without),
              parsed(method.only),
              method.weighted,
              method.reuse,
              context.model->classes ? std::optional<transport::ClassJoin>(*context.model->paths) : std::nullopt} {}

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_model(*context_.model,
                                 [&]<class M>(M) { return sample_with<M>(block, radiance, task_context); });
  }

 private:
  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) const {
    using Walks = BidirectionalSampler<M>;
    static thread_local const auto walks = std::make_unique<Walks>();
    std::array<Rgb, size_t{Walks::kWidth} * Walks::kHeight> part;
    uint64_t rays = 0;
    for (int top = 0; top < block.height; top += Walks::kHeight)
      for (int left = 0; left < block.width; left += Walks::kWidth) {
        const PixelBlock piece{block.x + left, block.y + top, std::min(Walks::kWidth, block.width - left),
                               std::min(Walks::kHeight, block.height - top), block.sample};
        const auto traced = walks->sample(context_, plan_, piece, part, task_context);
        if (!traced) return {};
        rays += *traced;
        const Rgb* next = part.data();
        for (int y = top; y < top + piece.height; ++y)
          for (int x = left; x < left + piece.width; ++x) radiance[static_cast<size_t>(y * block.width + x)] = *next++;
      }
    return rays;
  }

  const RenderContext context_;
  const BidirectionalOptions plan_;
};

}  // namespace

Result<void> accepts_techniques(std::string_view text) {
  const auto parsed = Techniques::parse(text);
  return parsed ? Result<void>() : parsed.error();
}

std::unique_ptr<RenderState> Bdpt::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<Samples>(*this, context);
}

Registration bdpt() { return registration<Bdpt>(); }

}  // namespace etendue::integrator
