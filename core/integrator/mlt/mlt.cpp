// Metropolis light transport            [Lang, sec. 9.4, eq. 9.112-9.124, corrected; Veach and Guibas 1997; Veach 1997]
//
// Markov chains over light paths with stationary density f*(x) / b, where f* is the luminance of the contribution and b
// its integral. Mutations propose a path y with the transition density T(x -> y), which is accepted with
//
//    a(x -> y)  =  min(1,  f*(y) T(y -> x) / (f*(x) T(x -> y)))
//
// Every iteration adds b f / f* to the pixel of its path; b is estimated from bootstrap samples, of which the chains
// start at some (markov_chain/markov_chain_renderer.h). Mutations: bidirectional, lens, caustic and multi-chain
// perturbations, lens subpath mutations.
//
// In scattering media, vertices in volumes are mutated as those on surfaces; distances are sampled by free flights. Media
// that emit are lights, at which light subpaths start.
//
//   Paths         E(D|G|S|V)*L; point lights: E.*(D|G|V)L, E(D|G|V).*L and E.*(D|G|V)(D|G|V).*L
//   Bias          consistent
//   Cost          about 3 rays per mutation, one mutation per pixel and sample; a path for each chain
//   Limitations   Inefficient for simple scenes, because successive samples are correlated. Paths at which no chain
//                 starts stay missing or spotty for long. Point lights seen in mirrors by way of a scattering surface
//                 are never found.
#include "integrator/integrator_base.h"
#include "integrator/markov_chain/markov_chain_renderer.h"
#include "integrator/mlt/bootstrap_paths.h"
#include "integrator/mlt/mutation_chain.h"
#include "integrator/registration.h"
#include "integrator/shared/camera_paths.h"

namespace etendue::integrator {

class Mlt final : public IntegratorBase<Mlt> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "mlt",
        .label = "Metropolis light transport",
        .summary =
            "Markov chains over light paths with bidirectional mutations and lens, caustic and multi-chain "
            "perturbations",
        .group = Group::markov_chain,
        .paths = "E(D|G|S|V)*L",
        .point_paths = "E.*(D|G|V)L|E(D|G|V).*L|E.*(D|G|V)(D|G|V).*L",
        .bias = Bias::consistent,
        .cost = "1 mutation per pixel and sample, about 3 rays; a path for each chain and one image besides the film",
        .limitations =
            "Inefficient for simple scenes, because successive samples are correlated. Paths at which no chain starts "
            "stay missing or spotty for long. Point lights seen in mirrors by way of a scattering surface are never "
            "found.",
        .accumulation = Accumulation::splats_only,
        .division = {DivisionUnit::none, false, "The Markov chains of a sample continue those of the sample before."},
        .shortcut = '7',
        .scattering_media = true,
        .heterogeneous_media = true,
        .emitting_media = true,
        .starts_in_media = true,
        .ignores_portals = true,
    };
  }

  Number<int> chains{"chains", "Chains",          512, {1, 65536}, "Parallel Markov chains per half-buffer",
                     "",       Scale::logarithmic};
  Number<int> candidates{"candidates",
                         "Bootstrap samples",
                         16384,
                         {16, 1 << 24},
                         "Pairs of subpaths that seed the chains of a half-buffer and estimate the image brightness. "
                         "Raising it reduces the "
                         "error of the brightness",
                         "",
                         Scale::logarithmic};
  Number<float> bidirectional{
      "bidirectional",
      "Bidirectional",
      1,
      {0.01f, 1},
      "Weight of bidirectional mutations, which replace parts of a path; required for chains to reach all paths"};
  Number<float> lens{
      "lens-perturbation", "Lens", 1, {0, 1}, "Weight of lens perturbations, which move the image point"};
  Number<float> caustic{"caustic-perturbation",
                        "Caustic",
                        1,
                        {0, 1},
                        "Weight of caustic perturbations, which turn the light's direction before the last surface"};
  Number<float> chain{"multi-chain",
                      "Multi-chain",
                      1,
                      {0, 1},
                      "Weight of multi-chain perturbations, for caustics seen in mirrors or through glass"};
  Number<float> subpath{"lens-subpath",
                        "Lens subpath",
                        1,
                        {0, 1},
                        "Weight of lens subpath mutations, which resample the image point, stratified over the image"};

  auto parameters() { return std::tie(max_depth, chains, candidates, bidirectional, lens, caustic, chain, subpath); }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const override;
};
namespace {

template <class M>
struct MutationGroup {
  ChainTally tally;
  std::vector<MutationChain<M>> chains;

  void write(StateWriter& out) const {
    out.value(tally);
    out.value<uint64_t>(chains.size());
    for (const auto& chain : chains) chain.write(out);
  }
  bool read(StateReader& in) {
    uint64_t size = 0;
    if (!in.value(tally) || !in.value(size) || size > kMaxChains) return false;
    chains.resize(size);
    for (auto& chain : chains)
      if (!chain.read(in)) return false;
    return true;
  }
  size_t memory() const {
    size_t bytes = sizeof *this + chains.capacity() * sizeof(MutationChain<M>);
    for (const auto& chain : chains) bytes += static_cast<size_t>(chain.path.edges()) * sizeof(PathVertex<M>);
    return bytes;
  }

  static constexpr uint64_t kMaxChains = 1 << 16;
};

template <class M>
class MutationKernel {
 public:
  using Group = MutationGroup<M>;
  using Epoch = integrator::Epoch;
  static constexpr int kGroupSize = 16;
  static constexpr uint64_t kMutationsPerCandidate = 40;
  static constexpr std::array<MutationKind, kMutations> kKinds{
      {{"bidirectional", "Bidirectional mutations that were accepted"},
       {"lens-perturbation", "Lens perturbations that were accepted"},
       {"caustic-perturbation", "Caustic perturbations that were accepted"},
       {"multi-chain", "Multi-chain perturbations that were accepted"},
       {"lens-subpath", "Lens subpath mutations that were accepted"}}};

  MutationKernel(const Mlt& integrator, const RenderContext& context)
      : integrator_(&integrator), context_(context), plan_(plan_of(integrator, context)) {}

  Epoch epoch() const { return {}; }
  int chains() const { return std::min<int>(integrator_->chains, context_.width * context_.height); }
  int candidates() const {
    return static_cast<int>(std::min<int64_t>(integrator_->candidates, int64_t{16} * context_.width * context_.height));
  }

  std::optional<uint64_t> evaluate_bootstrap(const Epoch& epoch, uint64_t first, const BootstrapSamples& candidates,
                                             const TaskContext& task_context) const {
    if (!should_continue(task_context)) return {};
    PathSpace<M> space(context_);
    BootstrapPaths<M> bootstrap_paths(integrator_->max_depth);
    LightPath<M> path;
    for (size_t i = 0; i < candidates.weights.size(); ++i) {
      ChainRandom random = bootstrap_random(epoch, first + i);
      candidates.weights[i] = static_cast<float>(bootstrap_paths.draw(space, random, path));
    }
    return space.take_rays();
  }

  std::optional<uint64_t> start(const Epoch& epoch, Group& group, int index, std::span<const uint64_t> candidates,
                                const TaskContext&) const {
    PathSpace<M> space(context_);
    BootstrapPaths<M> bootstrap_paths(integrator_->max_depth);
    group.chains.resize(candidates.size());
    for (size_t i = 0; i < candidates.size(); ++i) {
      MutationChain<M>& chain = group.chains[i];
      ChainRandom random = bootstrap_random(epoch, candidates[i]);
      bootstrap_paths.draw(space, random, chain.path);
      chain.shape = shape_of(chain.path);
      chain.random = ChainRandom(~epoch.key ^ mix_bits(epoch.first + chain_index(index, i) + 1));
    }
    return space.take_rays();
  }

  std::optional<uint64_t> mutate(const Epoch& epoch, Group& group, int index, int mutations, float scale,
                                 const TaskContext& task_context) const {
    if (!should_continue(task_context)) return {};
    MutationRunner<M> runner(context_, plan_);
    const auto count = [&](Mutation m, const AcceptanceDecision& v) {
      group.tally.kinds[static_cast<size_t>(m)].count(v);
    };
    const float path_scale = scale * static_cast<float>(epoch.mean_weight);
    for (size_t i = 0; i < group.chains.size(); ++i) {
      MutationChain<M>& chain = group.chains[i];
      const uint32_t number = chain_index(index, i);
      if (std::exchange(chain.needs_rebuild, false) && runner.space().rebuild(chain.path))
        chain.shape = shape_of(chain.path);
      const auto point = [&] {
        return stratified_point(number, static_cast<uint32_t>(chains()), chain.subpath_mutations++, epoch.key);
      };
      for (int n = 0; n < mutations; ++n) runner.step(chain, path_scale, point, count, *task_context.splats);
      runner.finish(chain, path_scale, *task_context.splats);
    }
    return runner.space().take_rays();
  }

 private:
  static MutationPlan plan_of(const Mlt& integrator, const RenderContext& context) {
    // The largest displacement is the radius of a circle of five percent of the image area.
    const float max_move =
        std::sqrt(0.05f * static_cast<float>(context.width) * static_cast<float>(context.height) / kPi);
    const Bounds& bounds = context.scene->bounds();
    return {MutationChoice(
                {integrator.bidirectional, integrator.lens, integrator.caustic, integrator.chain, integrator.subpath}),
            EdgeCounts(integrator.max_depth),
            {0.1f, std::max(max_move, 1.0f)},
            {1e-4f, 0.1f},
            bounds.empty() ? 1.0f : std::max(glm::distance(bounds.min, bounds.max), 1e-3f)};
  }

  static ChainRandom bootstrap_random(const Epoch& epoch, uint64_t candidate) {
    return ChainRandom(epoch.key ^ mix_bits(candidate + 1));
  }

  // The index of a chain among all of the half-buffer.
  static uint32_t chain_index(int group, size_t i) {
    return static_cast<uint32_t>(static_cast<size_t>(group) * kGroupSize + i);
  }

  const Mlt* integrator_;
  RenderContext context_;
  MutationPlan plan_;
};

}  // namespace

std::unique_ptr<RenderState> Mlt::begin(const RenderContext& context, const RenderState*) const {
  return transport::with_scattering_model(*context.model, [&]<class M>(M) -> std::unique_ptr<RenderState> {
    return std::make_unique<MarkovChainRenderState<MutationKernel<M>>>(context, MutationKernel<M>(*this, context));
  });
}

Registration mlt() { return registration<Mlt>(); }

}  // namespace etendue::integrator
