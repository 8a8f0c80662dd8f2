// Metropolis light transport in primary sample space                              [Kelemen et al. 2002; Lang, sec. 9.4]
//
// A path is a function of the random numbers that sample it. Markov chains explore the unit cube of these numbers with
// a stationary density proportional to the target function: the luminance of the contribution of a sample to the image.
// A state u contributes in every iteration
//
//    b f(u) / (f*(u) N),        f* = luminance of f,   b = mean of f* over bootstrap samples
//
// Proposals are large steps, which draw all numbers anew, and small steps, which change all numbers by distances
// between two bounds, uniform in their logarithm. The form defines the samples:
//
//    path           a path from the camera with direct light at every vertex
//    bidirectional  subpaths from both ends with all their connections
//    multiplexed    some of the techniques (s, t): all with the same s and t > 1, or all with the same t < 2, multiplied
//                   by their MIS weights and divided by the probability of this choice. Small steps change the choice.
//                   The probabilities are learned (technique_distribution.h). After [Hachisuka et al. 2014], where a
//                   sample has a single technique; with all lengths of a camera path it costs little more, and varies
//                   much less.
//
// Decisions of stochastic opacity are made in large steps and are constant in between.
//
//   Paths         E(D|G|S|V)*L; point lights: E.*(D|G|V)L, E(D|G|V).*L and E.*(D|G|V)(D|G|V).*L
//   Bias          consistent
//   Cost          one sample of its form per mutation; random numbers and splats of every chain
//   Limitations   Inefficient for simple scenes, because successive samples are correlated. Noise appears as blotches.
//                 The brightness comes from independent samples: too dark until they have found rare, bright paths.
#include "integrator/integrator_base.h"
#include "integrator/markov_chain/markov_chain_renderer.h"
#include "integrator/pssmlt/primary_sample_target.h"
#include "integrator/registration.h"
#include "transport/mis/mis.h"

template <>
struct etendue::Options<etendue::integrator::PrimaryForm> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"path", "Path"}, {"bidirectional", "Bidirectional"}, {"multiplexed", "Multiplexed"}}};
};

namespace etendue::integrator {

class Pssmlt final : public IntegratorBase<Pssmlt> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "pssmlt",
        .label = "Primary sample space MLT",
        .summary = "Markov chains in the space of the random numbers of paths; the sampler has no effect",
        .group = Group::markov_chain,
        .paths = "E(D|G|S|V)*L",
        .point_paths = "E.*(D|G|V)L|E(D|G|V).*L|E.*(D|G|V)(D|G|V).*L",
        .bias = Bias::consistent,
        .cost = "1 sample of its form per mutation; random numbers and splats of every chain",
        .limitations =
            "Inefficient for simple scenes, because successive samples are correlated. Noise appears as blotches that "
            "resemble structure. The brightness comes from independent samples: too dark until they have found rare, "
            "bright paths.",
        .accumulation = Accumulation::splats_only,
        .division = {DivisionUnit::none, false, "The Markov chains of a sample continue those of the sample before."},
        .scattering_media = true,
        .heterogeneous_media = true,
        .emitting_media = true,
        .ignores_portals = true,
    };
  }

  Choice<PrimaryForm> form{"form", "Form", PrimaryForm::bidirectional,
                           "The kind of sample that a point of primary sample space defines"};
  Number<float> large_steps{"large-steps",
                            "Large step probability",
                            0.3f,
                            {0.01f, 1},
                            "Share of mutations that draw all random numbers anew. Raising it finds new paths more "
                            "often and explores bright ones less"};
  Number<float> step{"step",
                     "Largest small step",
                     1.0f / 64,
                     {1e-4f, 0.25f},
                     "Largest change of a random number; for the first two, in image widths and heights",
                     "",
                     Scale::logarithmic};
  Number<float> least_step{
      "least-step", "Smallest small step", 1.0f / 1024, {1e-6f, 0.25f}, "Smallest change of a random number",
      "",           Scale::logarithmic};
  Number<int> chains{
      "chains", "Chains",          4096, {1, 1 << 20}, "Parallel Markov chains per half-buffer; at most one per pixel",
      "",       Scale::logarithmic};
  Number<int> candidates{"candidates",
                         "Bootstrap samples",
                         16384,
                         {1, 1 << 24},
                         "Independent samples that seed the first chains and estimate the image brightness; at most 16 "
                         "per pixel. Later epochs have more",
                         "",
                         Scale::logarithmic};
  Toggle combined{"combined", "Combine large steps (MIS)", true,
                  "Records large steps as independent samples as well, weighted against the chains by multiple "
                  "importance sampling"};
  Choice<transport::MisHeuristic> heuristic{"heuristic", "MIS heuristic", transport::MisHeuristic::power,
                                            "How the techniques that find a path are weighted"};
  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};

  auto parameters() {
    return std::tie(max_depth, form, large_steps, step, least_step, chains, candidates, combined, heuristic,
                    roulette_start);
  }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const override;
};

namespace {

PrimarySampleTarget& thread_target() {
  static thread_local const auto target_paths = std::make_unique<PrimarySampleTarget>();
  return *target_paths;
}

double to_unit_double(uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

// The state of a chain; its random numbers are stored with those of its group.
struct PrimaryState {
  uint64_t root = 0;
  float target = 0;
  film::Splats splats;
};

struct PrimaryGroup {
  ChainTally tally;
  uint64_t mutations = 0;
  PrimarySamplePoints points;
  std::vector<PrimaryState> states;

  void write(StateWriter& out) const {
    out.value(tally);
    out.value(mutations);
    out.value(points.clocks);
    for (const auto& blocks : points.streams) out.list(std::span(blocks));
    out.value<uint64_t>(states.size());
    for (const PrimaryState& s : states) {
      out.value(s.root);
      out.value(s.target);
      out.list(std::span(s.splats));
    }
  }
  bool read(StateReader& in) {
    if (!in.value(tally) || !in.value(mutations) || !in.value(points.clocks)) return false;
    for (auto& blocks : points.streams)
      if (!in.list(blocks)) return false;
    uint64_t size = 0;
    if (!in.value(size) || size > PrimarySamplePoints::kLanes) return false;
    states.resize(size);
    for (PrimaryState& s : states)
      if (!in.value(s.root) || !in.value(s.target) || !in.list(s.splats)) return false;
    return true;
  }
  size_t memory() const {
    size_t bytes = sizeof *this + points.memory() + states.capacity() * sizeof(PrimaryState);
    for (const PrimaryState& s : states) bytes += s.splats.capacity() * sizeof(film::Splat);
    return bytes;
  }
};

struct PrimaryEpoch : Epoch {
  TechniqueDistribution distribution;
};

class PrimaryKernel {
 public:
  using Group = PrimaryGroup;
  using Epoch = PrimaryEpoch;
  static constexpr uint64_t kMutationsPerCandidate = 10;
  static constexpr std::array<MutationKind, 2> kKinds{
      {{"large-steps", "Mutations that drew all numbers anew and were accepted"},
       {"small-steps", "Mutations that moved all numbers a little and were accepted"}}};

  PrimaryKernel(const Pssmlt& integrator, const RenderContext& context)
      : integrator_(&integrator),
        context_(context),
        options_{.heuristic = integrator.heuristic,
                 .max_depth = integrator.max_depth,
                 .roulette_start = integrator.roulette_start,
                 .classes = class_join(*context.model)} {}

  int chains() const { return std::min<int>(integrator_->chains, context_.width * context_.height); }
  int candidates() const {
    return static_cast<int>(std::min<int64_t>(integrator_->candidates, int64_t{16} * context_.width * context_.height));
  }

  Epoch epoch() const { return {{}, TechniqueDistribution(integrator_->max_depth, context_.camera->can_be_hit())}; }

  std::optional<uint64_t> evaluate_bootstrap(const Epoch& epoch, uint64_t first, const BootstrapSamples& candidates,
                                             const TaskContext& task_context) const {
    PrimarySampleTarget& target_paths = thread_target();
    const auto rays = evaluate(
        epoch, target_paths, candidates.weights.size(), [&](size_t i) { return first + i; }, PrimarySamplePoints(),
        task_context);
    if (rays) std::copy_n(target_paths.targets.begin(), candidates.weights.size(), candidates.weights.begin());
    if (rays) std::copy_n(target_paths.kinds.begin(), candidates.kinds.size(), candidates.kinds.begin());
    return rays;
  }

  std::optional<uint64_t> start(const Epoch& epoch, Group& group, int, std::span<const uint64_t> candidates,
                                const TaskContext& task_context) const {
    PrimarySampleTarget& target_paths = thread_target();
    group.points = {};
    const auto rays = evaluate(
        epoch, target_paths, candidates.size(), [&](size_t i) { return candidates[i]; }, group.points, task_context);
    if (!rays) return {};
    group.states.resize(candidates.size());
    for (size_t i = 0; i < candidates.size(); ++i) accept(target_paths, i, group);
    return rays;
  }

  std::optional<uint64_t> mutate(const Epoch& epoch, Group& group, int index, int mutations, float scale,
                                 const TaskContext& task_context) const {
    PrimarySampleTarget& target_paths = thread_target();
    const uint64_t group_key = mix_bits(epoch.key ^ mix_bits(static_cast<uint64_t>(index) + 1));
    const Recorder count{scale, epoch, integrator_->combined ? double{integrator_->large_steps} : 0.0};
    std::array<Occupancy, PrimarySampleTarget::kLanes> occupancies;
    uint64_t rays = 0;
    for (int i = 0; i < mutations; ++i, ++group.mutations) {
      const uint64_t key = mix_bits(group_key + group.mutations);
      propose(group, key, target_paths, task_context);
      const auto traced = target_paths.evaluate(context_, integrator_->form, options_, epoch.distribution,
                                                group.states.size(), task_context);
      if (!traced) return {};
      rays += *traced;
      const Stopwatch::Lap lap(task_context.overhead_timer);
      for (size_t lane = 0; lane < group.states.size(); ++lane)
        update_chain(group, lane, lane_key_of(key, lane), target_paths, occupancies[lane], count, *task_context.splats);
    }
    const Stopwatch::Lap lap(task_context.overhead_timer);
    for (size_t lane = 0; lane < group.states.size(); ++lane)
      count.record(group.states[lane].splats, group.states[lane].target, occupancies[lane].take_remaining(),
                   *task_context.splats);
    return rays;
  }

 private:
  // The contribution of a state. The chain alone counts b f / f* per iteration. Where large steps count as well,
  // multiple importance sampling combines both [Kelemen et al. 2002, sec. 3.2]: the chain has the density f* / b, large
  // steps the density 1 with their share of all mutations. The weights must not depend on the bootstrap samples of the
  // same epoch, so b is estimated from the previous epochs; in the first epoch the chains alone count.
  struct Recorder {
    float scale;
    double mean_weight, expected_weight, large_steps;  // large_steps: share of all mutations, zero if they do not count

    Recorder(float s, const Epoch& epoch, double large)
        : scale(s), mean_weight(epoch.mean_weight), expected_weight(epoch.expected_weight()), large_steps(large) {}

    void record(const film::Splats& splats, float target, double iterations, film::Splats& to) const {
      if (!(target > 0) || !(iterations > 0)) return;
      const auto weight =
          static_cast<float>(iterations * mean_weight / (double{target} + large_steps * expected_weight)) * scale;
      for (const film::Splat& splat : splats) to.push_back({splat.pixel, splat.radiance * weight});
    }
  };

  static uint64_t lane_key_of(uint64_t key, size_t lane) { return mix_bits(key + (lane + 1) * 0x9e3779b97f4a7c15ULL); }
  bool is_large(uint64_t lane_key) const {
    return to_unit_double(mix_bits(lane_key ^ 1)) < double{integrator_->large_steps};
  }

  template <class NumberOf>
  std::optional<uint64_t> evaluate(const Epoch& epoch, PrimarySampleTarget& target_paths, size_t count,
                                   NumberOf&& bootstrap_index, const PrimarySamplePoints& points,
                                   const TaskContext& task_context) const {
    target_paths.proposals.begin(points, {integrator_->least_step, integrator_->step}, task_context.overhead_timer);
    for (size_t i = 0; i < count; ++i) {
      target_paths.roots[i] = mix_bits(epoch.key + (bootstrap_index(i) + 1) * 0xd1342543de82ef95ULL);
      target_paths.proposals.propose(i, target_paths.roots[i], true);
    }
    return target_paths.evaluate(context_, integrator_->form, options_, epoch.distribution, count, task_context);
  }

  void propose(const Group& group, uint64_t key, PrimarySampleTarget& target_paths,
               const TaskContext& task_context) const {
    const Stopwatch::Lap lap(task_context.overhead_timer);
    target_paths.proposals.begin(group.points, {integrator_->least_step, integrator_->step},
                                 task_context.overhead_timer);
    for (size_t lane = 0; lane < group.states.size(); ++lane) {
      const uint64_t lane_key = lane_key_of(key, lane);
      const bool large = is_large(lane_key);
      target_paths.roots[lane] = large ? lane_key : group.states[lane].root;
      target_paths.proposals.propose(lane, lane_key, large);
    }
  }

  void update_chain(Group& group, size_t lane, uint64_t lane_key, PrimarySampleTarget& target_paths,
                    Occupancy& occupancy, const Recorder& count, film::Splats& splats) const {
    const bool large = is_large(lane_key);
    const PrimaryState& current = group.states[lane];
    const float target = target_paths.targets[lane];
    const AcceptanceDecision decision =
        decide_acceptance(double{current.target}, double{target}, to_unit_double(mix_bits(lane_key ^ 2)));
    group.tally.kinds[large ? 0 : 1].count(decision);
    occupancy.record(
        decision, [&](double n) { count.record(current.splats, current.target, n, splats); },
        [&](double n) { count.record(target_paths.splats[lane], target, n, splats); },
        large && integrator_->combined && target > 0 ? count.expected_weight / count.mean_weight : 0.0);
    if (decision.accepted) accept(target_paths, lane, group);
  }

  // Replaces the state of the chain by its proposal.
  static void accept(PrimarySampleTarget& target_paths, size_t lane, Group& group) {
    target_paths.proposals.accept(lane, group.points);
    PrimaryState& state = group.states[lane];
    state.root = target_paths.roots[lane];
    state.target = target_paths.targets[lane];
    std::swap(state.splats, target_paths.splats[lane]);
  }

  const Pssmlt* integrator_;
  RenderContext context_;
  BidirectionalOptions options_;
};

}  // namespace

std::unique_ptr<RenderState> Pssmlt::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<MarkovChainRenderState<PrimaryKernel>>(context, PrimaryKernel(*this, context));
}

Registration pssmlt() { return registration<Pssmlt>(); }

}  // namespace etendue::integrator
