// Metropolis light transport in primary sample space.       Kelemen, Szirmay-Kalos, Antal, Csonka 2002; thesis 9.4
//
// A path is a function of the random numbers that it asks for. Markov chains wander through the cube of these numbers,
// where all are equally likely, and stay where the function is large: f is the luminance of everything that one sample
// of the whole picture brings. What a sample is, the form says:
//
//   path           a walk from the camera, with direct light at every vertex
//   bidirectional  a walk from either end, and every connection of them
//   multiplexed    one technique (s, t) of paths of one length, times the number of techniques and with its weight
//                  among them (Hachisuka, Kaplanyan, Dachsbacher 2014). The technique is a number like the others;
//                  the length changes with large steps alone. How often each is tried is learned (technique_law.h)
//
// Decisions of stochastic opacity, and the length, are drawn with each large step and stay as they are in between.
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
        .label = "Metropolis, primary space",
        .summary =
            "Markov chains through the random numbers of paths: what is bright is looked at again, a little changed. "
            "Chains have their own numbers: the sampler plays no part",
        .group = Group::markov_chain,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G)L|E(D|G).*L|E.*(D|G)(D|G).*L",
        .bias = Bias::consistent,
        .cost =
            "one sample of its form for each mutation; numbers and splats of every chain; brightness is known from "
            "independent samples alone, and too dark until they have found what is rare and bright",
        .limitations =
            "simple scenes, where samples of equal effort do better alone: neighbours in a chain are alike; noise in "
            "blotches that looks like structure",
        .accumulation = Accumulation::splats_only,
    };
  }

  Choice<PrimaryForm> form{"form", "Form", PrimaryForm::bidirectional,
                           "What a point of primary sample space stands for"};
  Number<float> large_steps{
      "large-steps", "Large steps", 0.3f, {0.01f, 1}, "Share of the mutations that draw all numbers anew"};
  Number<float> step{"step",
                     "Largest small step",
                     1.0f / 64,
                     {1e-4f, 0.25f},
                     "How far a number moves at most; of the picture's width, too",
                     "",
                     Scale::logarithmic};
  Number<float> least_step{
      "least-step", "Smallest small step", 1.0f / 1024, {1e-6f, 0.25f}, "How far a number moves at least",
      "",           Scale::logarithmic};
  Number<int> chains{"chains",
                     "Chains",
                     4096,
                     {1, 1 << 20},
                     "Markov chains side by side in each half of the film; one for each pixel at most",
                     "",
                     Scale::logarithmic};
  Number<int> candidates{"candidates",
                         "Candidates",
                         16384,
                         {1, 1 << 24},
                         "Independent samples among which the first chains choose their starts, 16 for each pixel at "
                         "most; later ones have more",
                         "",
                         Scale::logarithmic};
  Toggle combined{"combined", "Large steps count", true,
                  "Large steps are independent samples too: both ways to a path share it by their densities"};
  Choice<transport::MisHeuristic> heuristic{"heuristic", "MIS heuristic", transport::MisHeuristic::power,
                                            "How the techniques that find a path share it"};
  Number<int> roulette_start{"roulette-start",
                             "Roulette from vertex",
                             4,
                             {1, 64},
                             "Earlier ends more paths: faster, noisier; its decisions are numbers as any other"};

  auto parameters() {
    return std::tie(max_depth, form, large_steps, step, least_step, chains, candidates, combined, heuristic,
                    roulette_start);
  }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const override;
};

namespace {

PrimarySampleTarget& paths_of_thread() {
  static thread_local const auto paths = std::make_unique<PrimarySampleTarget>();
  return *paths;
}

double unit_double(uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

// Where a chain is: its numbers stand beside those of its neighbours.
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
  TechniqueDistribution law;
};

class PrimaryKernel {
 public:
  using Group = PrimaryGroup;
  using Epoch = PrimaryEpoch;
  static constexpr uint64_t kMutationsPerCandidate = 10;
  static constexpr std::array<MutationKind, 2> kKinds{
      {{"large-steps", "Mutations that drew all numbers anew and were accepted"},
       {"small-steps", "Mutations that moved all numbers a little and were accepted"}}};

  PrimaryKernel(const Pssmlt& method, const RenderContext& context)
      : method_(&method),
        context_(context),
        plan_{method.heuristic,
              method.max_depth,
              method.roulette_start,
              *Techniques::parse(""),
              *Techniques::parse(""),
              true,
              true,
              context.model->classes ? std::optional<transport::ClassJoin>(*context.model->paths) : std::nullopt} {}

  int chains() const { return std::min<int>(method_->chains, context_.width * context_.height); }
  int candidates() const {
    return static_cast<int>(std::min<int64_t>(method_->candidates, int64_t{16} * context_.width * context_.height));
  }

  Epoch epoch() const { return {{}, TechniqueDistribution(method_->max_depth, context_.camera->can_be_hit())}; }

  std::optional<uint64_t> weigh(const Epoch& epoch, uint64_t first, const BootstrapSamples& candidates,
                                const TaskContext& task_context) const {
    PrimarySampleTarget& paths = paths_of_thread();
    const auto rays = look_at(
        epoch, paths, candidates.weight.size(), [&](size_t i) { return first + i; }, PrimarySamplePoints(),
        task_context);
    if (rays) std::copy_n(paths.targets.begin(), candidates.weight.size(), candidates.weight.begin());
    if (rays) std::copy_n(paths.kinds.begin(), candidates.kinds.size(), candidates.kinds.begin());
    return rays;
  }

  std::optional<uint64_t> start(const Epoch& epoch, Group& group, int, std::span<const uint64_t> candidates,
                                const TaskContext& task_context) const {
    PrimarySampleTarget& paths = paths_of_thread();
    group.points = {};
    const auto rays = look_at(
        epoch, paths, candidates.size(), [&](size_t i) { return candidates[i]; }, group.points, task_context);
    if (!rays) return {};
    group.states.resize(candidates.size());
    for (size_t i = 0; i < candidates.size(); ++i) go(paths, i, group);
    return rays;
  }

  std::optional<uint64_t> mutate(const Epoch& epoch, Group& group, int index, int mutations, float scale,
                                 const TaskContext& task_context) const {
    PrimarySampleTarget& paths = paths_of_thread();
    const uint64_t group_key = mix_bits(epoch.key ^ mix_bits(static_cast<uint64_t>(index) + 1));
    const Count count{scale, epoch, method_->combined ? double{method_->large_steps} : 0.0};
    std::array<Stay, PrimarySampleTarget::kLanes> stays;
    uint64_t rays = 0;
    for (int i = 0; i < mutations; ++i, ++group.mutations) {
      const uint64_t key = mix_bits(group_key + group.mutations);
      propose(group, key, paths, task_context);
      const auto traced = paths.evaluate(context_, method_->form, plan_, epoch.law, group.states.size(), task_context);
      if (!traced) return {};
      rays += *traced;
      const Stopwatch::Lap lap(task_context.overhead_timer);
      for (size_t lane = 0; lane < group.states.size(); ++lane)
        decide(group, lane, key_of(key, lane), paths, stays[lane], count, *task_context.splats);
    }
    const Stopwatch::Lap lap(task_context.overhead_timer);
    for (size_t lane = 0; lane < group.states.size(); ++lane)
      count.record(group.states[lane].splats, group.states[lane].target, stays[lane].settle(), *task_context.splats);
    return rays;
  }

 private:
  // What a state counts. By itself the chain's part is worth / target. Where large steps count as well, each takes the
  // share of its density: the chain that of target / worth, large steps that of theirs among all mutations (Kelemen et
  // al., section 3.2). How they share must not depend on what the candidates of this very era were worth: in
  // the first era, when nothing else is known, the chains alone count.
  struct Count {
    float scale;
    double mean_weight, expected, large_steps;  // the last: share of all mutations, zero if they do not count

    Count(float s, const Epoch& epoch, double large)
        : scale(s), mean_weight(epoch.weight), expected(epoch.expected()), large_steps(large) {}

    void record(const film::Splats& splats, float target, double iterations, film::Splats& to) const {
      if (!(target > 0) || !(iterations > 0)) return;
      const auto weight =
          static_cast<float>(iterations * mean_weight / (double{target} + large_steps * expected)) * scale;
      for (const film::Splat& splat : splats) to.push_back({splat.pixel, splat.radiance * weight});
    }
  };

  static uint64_t key_of(uint64_t key, size_t lane) { return mix_bits(key + (lane + 1) * 0x9e3779b97f4a7c15ULL); }
  bool is_large(uint64_t lane_key) const { return unit_double(mix_bits(lane_key ^ 1)) < double{method_->large_steps}; }

  template <class NumberOf>
  std::optional<uint64_t> look_at(const Epoch& epoch, PrimarySampleTarget& paths, size_t count, NumberOf&& number_of,
                                  const PrimarySamplePoints& points, const TaskContext& task_context) const {
    paths.proposals.begin(points, {method_->least_step, method_->step}, task_context.overhead_timer);
    for (size_t i = 0; i < count; ++i) {
      paths.roots[i] = mix_bits(epoch.key + (number_of(i) + 1) * 0xd1342543de82ef95ULL);
      paths.proposals.propose(i, paths.roots[i], true);
    }
    return paths.evaluate(context_, method_->form, plan_, epoch.law, count, task_context);
  }

  void propose(const Group& group, uint64_t key, PrimarySampleTarget& paths, const TaskContext& task_context) const {
    const Stopwatch::Lap lap(task_context.overhead_timer);
    paths.proposals.begin(group.points, {method_->least_step, method_->step}, task_context.overhead_timer);
    for (size_t lane = 0; lane < group.states.size(); ++lane) {
      const uint64_t lane_key = key_of(key, lane);
      const bool large = is_large(lane_key);
      paths.roots[lane] = large ? lane_key : group.states[lane].root;
      paths.proposals.propose(lane, lane_key, large);
    }
  }

  void decide(Group& group, size_t lane, uint64_t lane_key, PrimarySampleTarget& paths, Stay& stay, const Count& count,
              film::Splats& splats) const {
    const bool large = is_large(lane_key);
    const PrimaryState& present = group.states[lane];
    const float target = paths.targets[lane];
    const Verdict verdict = judge(double{present.target}, double{target}, unit_double(mix_bits(lane_key ^ 2)));
    group.tally.kinds[large ? 0 : 1].count(verdict);
    stay.take(
        verdict, [&](double n) { count.record(present.splats, present.target, n, splats); },
        [&](double n) { count.record(paths.found[lane], target, n, splats); },
        large && method_->combined && target > 0 ? count.expected / count.mean_weight : 0.0);
    if (verdict.accepted) go(paths, lane, group);
  }

  // The chain goes to its proposal.
  static void go(PrimarySampleTarget& paths, size_t lane, Group& group) {
    paths.proposals.accept(lane, group.points);
    PrimaryState& state = group.states[lane];
    state.root = paths.roots[lane];
    state.target = paths.targets[lane];
    std::swap(state.splats, paths.found[lane]);
  }

  const Pssmlt* method_;
  RenderContext context_;
  BidirectionalOptions plan_;
};

}  // namespace

std::unique_ptr<RenderState> Pssmlt::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<MarkovChainRenderState<PrimaryKernel>>(context, PrimaryKernel(*this, context));
}

Registration pssmlt() { return registration<Pssmlt>(); }

}  // namespace etendue::integrator
