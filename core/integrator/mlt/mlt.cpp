// Metropolis light transport: Markov chains over whole paths.    thesis 9.4, (9.112)-(9.124), errata E27-E29; Veach &
// Guibas 1997; digest 8-10: S23-S29
//
// A chain goes from path to path by mutations, and stays at each for as long as its brightness asks for: it is at a
// path x with the density f(x) / b, and what it visits is the picture but for the factor b, the mean of what paths from
// nothing are worth. Chains start from such paths, chosen by what they are worth (chain_work.h).
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
            "Markov chains over whole paths, which change by bidirectional mutations and by perturbations of the lens, "
            "of caustics and of chains of them",
        .group = Group::markov_chain,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G)L|E(D|G).*L|E.*(D|G)(D|G).*L",
        .bias = Bias::consistent,
        .cost =
            "a mutation for each pixel and sample, about 3 rays; a path for each chain and a picture beside the film",
        .limitations =
            "simple scenes, where samples that depend on each other are worse than others; paths that no chain starts "
            "from stay missing or spotty for long; point lights seen in mirrors by way of something that scatters: "
            "never",
        .accumulation = Accumulation::splats_only,
        .shortcut = '7',
    };
  }

  Number<int> chains{"chains", "Chains",          512, {1, 65536}, "Of each half of the samples, side by side",
                     "",       Scale::logarithmic};
  Number<int> candidates{
      "candidates",
      "Candidates",
      16384,
      {16, 1 << 24},
      "Pairs of walks, whose paths the chains of a half start from; more make the brightness of the picture surer",
      "",
      Scale::logarithmic};
  Number<float> bidirectional{
      "bidirectional",
      "Bidirectional",
      1,
      {0.01f, 1},
      "How often, against the others: new paths; without them chains would stay where they are"};
  Number<float> lens{"lens-perturbation", "Lens", 1, {0, 1}, "How often: the point of the picture is moved"};
  Number<float> caustic{"caustic-perturbation",
                        "Caustic",
                        1,
                        {0, 1},
                        "How often: the light's direction is turned before it meets the last surface"};
  Number<float> chain{"multi-chain", "Multi-chain", 1, {0, 1}, "How often: caustics seen in mirrors or through glass"};
  Number<float> subpath{"lens-subpath",
                        "Lens subpath",
                        1,
                        {0, 1},
                        "How often: the point of the picture is chosen anew, all parts of the picture alike"};

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
    if (!in.value(tally) || !in.value(size) || size > kMost) return false;
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

  static constexpr uint64_t kMost = 1 << 16;
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

  MutationKernel(const Mlt& method, const RenderContext& context)
      : method_(&method), context_(context), plan_(plan_of(method, context)) {}

  Epoch epoch() const { return {}; }
  int chains() const { return std::min<int>(method_->chains, context_.width * context_.height); }
  int candidates() const {
    return static_cast<int>(std::min<int64_t>(method_->candidates, int64_t{16} * context_.width * context_.height));
  }

  std::optional<uint64_t> weigh(const Epoch& epoch, uint64_t first, const BootstrapSamples& candidates,
                                const TaskContext& task_context) const {
    if (!should_continue(task_context)) return {};
    PathSpace<M> space(context_);
    PathCandidates<M> paths(method_->max_depth);
    LightPath<M> path;
    for (size_t i = 0; i < candidates.weight.size(); ++i) {
      ChainRandom random = random_of_candidate(epoch, first + i);
      candidates.weight[i] = static_cast<float>(paths.draw(space, random, path));
    }
    return space.take_rays();
  }

  std::optional<uint64_t> start(const Epoch& epoch, Group& group, int index, std::span<const uint64_t> candidates,
                                const TaskContext&) const {
    PathSpace<M> space(context_);
    PathCandidates<M> paths(method_->max_depth);
    group.chains.resize(candidates.size());
    for (size_t i = 0; i < candidates.size(); ++i) {
      MutationChain<M>& chain = group.chains[i];
      ChainRandom random = random_of_candidate(epoch, candidates[i]);
      paths.draw(space, random, chain.path);
      chain.shape = shape_of(chain.path);
      chain.random = ChainRandom(~epoch.key ^ mix_bits(epoch.first + number_of(index, i) + 1));
    }
    return space.take_rays();
  }

  std::optional<uint64_t> mutate(const Epoch& epoch, Group& group, int index, int mutations, float scale,
                                 const TaskContext& task_context) const {
    if (!should_continue(task_context)) return {};
    MutationRunner<M> runner(context_, plan_);
    const auto count = [&](Mutation m, const Verdict& v) { group.tally.kinds[static_cast<size_t>(m)].count(v); };
    const float of_path = scale * static_cast<float>(epoch.weight);
    for (size_t i = 0; i < group.chains.size(); ++i) {
      MutationChain<M>& chain = group.chains[i];
      const uint32_t number = number_of(index, i);
      if (std::exchange(chain.bare, false) && runner.space().rebuild(chain.path)) chain.shape = shape_of(chain.path);
      const auto point = [&] {
        return stratified_point(number, static_cast<uint32_t>(chains()), chain.rounds++, epoch.key);
      };
      for (int n = 0; n < mutations; ++n) runner.step(chain, of_path, point, count, *task_context.splats);
      runner.settle(chain, of_path, *task_context.splats);
    }
    return runner.space().take_rays();
  }

 private:
  static MutationPlan plan_of(const Mlt& method, const RenderContext& context) {
    // The largest move goes over five percent of the picture's area.
    const float widest =
        std::sqrt(0.05f * static_cast<float>(context.width) * static_cast<float>(context.height) / kPi);
    const Bounds& bounds = context.scene->bounds();
    return {MutationChoice({method.bidirectional, method.lens, method.caustic, method.chain, method.subpath}),
            EdgeCounts(method.max_depth),
            {0.1f, std::max(widest, 1.0f)},
            {1e-4f, 0.1f},
            bounds.empty() ? 1.0f : std::max(glm::distance(bounds.min, bounds.max), 1e-3f)};
  }

  static ChainRandom random_of_candidate(const Epoch& epoch, uint64_t candidate) {
    return ChainRandom(epoch.key ^ mix_bits(candidate + 1));
  }

  // Of a chain among all of the half.
  static uint32_t number_of(int group, size_t i) {
    return static_cast<uint32_t>(static_cast<size_t>(group) * kGroupSize + i);
  }

  const Mlt* method_;
  RenderContext context_;
  MutationPlan plan_;
};

}  // namespace

std::unique_ptr<RenderState> Mlt::begin(const RenderContext& context, const RenderState*) const {
  return transport::with_model(*context.model, [&]<class M>(M) -> std::unique_ptr<RenderState> {
    return std::make_unique<MarkovChainRenderState<MutationKernel<M>>>(context, MutationKernel<M>(*this, context));
  });
}

Registration mlt() { return registration<Mlt>(); }

}  // namespace etendue::integrator
