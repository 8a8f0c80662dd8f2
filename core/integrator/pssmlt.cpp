#include "integrator/pssmlt.h"

#include "integrator/chain_work.h"
#include "integrator/primary_paths.h"

namespace etendue::integrator {
namespace {

PrimaryPaths& paths_of_thread() {
  static thread_local const auto paths = std::make_unique<PrimaryPaths>();
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
  PrimaryPoints points;
  std::vector<PrimaryState> states;

  void write(StateWriter& out) const {
    out.value(tally), out.value(mutations), out.value(points.clocks);
    for (const auto& blocks : points.streams) out.list(std::span(blocks));
    out.value<uint64_t>(states.size());
    for (const PrimaryState& s : states) out.value(s.root), out.value(s.target), out.list(std::span(s.splats));
  }
  bool read(StateReader& in) {
    if (!in.value(tally) || !in.value(mutations) || !in.value(points.clocks)) return false;
    for (auto& blocks : points.streams)
      if (!in.list(blocks)) return false;
    uint64_t size = 0;
    if (!in.value(size) || size > PrimaryPoints::kLanes) return false;
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

struct PrimaryEra : Era {
  TechniqueLaw law;
};

class PrimaryKernel {
 public:
  using Group = PrimaryGroup;
  using Era = PrimaryEra;
  static constexpr uint64_t kMutationsPerCandidate = 10;
  static constexpr std::array<MutationKind, 2> kKinds{
      {{"large-steps", "Mutations that drew all numbers anew and were accepted"},
       {"small-steps", "Mutations that moved all numbers a little and were accepted"}}};

  PrimaryKernel(const Pssmlt& method, const Pass& pass)
      : method_(&method),
        pass_(pass),
        plan_{method.heuristic,
              method.max_depth,
              method.roulette_start,
              *Techniques::parse(""),
              *Techniques::parse(""),
              true,
              true,
              pass.model->classes ? std::optional<transport::ClassJoin>(*pass.model->paths) : std::nullopt} {}

  int chains() const { return std::min<int>(method_->chains, pass_.width * pass_.height); }
  int candidates() const {
    return static_cast<int>(std::min<int64_t>(method_->candidates, int64_t{16} * pass_.width * pass_.height));
  }

  Era era() const { return {{}, TechniqueLaw(method_->max_depth, pass_.camera->can_be_hit())}; }

  std::optional<uint64_t> weigh(const Era& era, uint64_t first, const Candidates& candidates, const Turn& turn) const {
    PrimaryPaths& paths = paths_of_thread();
    const auto rays = look_at(
        era, paths, candidates.worth.size(), [&](size_t i) { return first + i; }, PrimaryPoints(), turn);
    if (rays) std::copy_n(paths.targets.begin(), candidates.worth.size(), candidates.worth.begin());
    if (rays) std::copy_n(paths.kinds.begin(), candidates.kinds.size(), candidates.kinds.begin());
    return rays;
  }

  std::optional<uint64_t> start(const Era& era, Group& group, int, std::span<const uint64_t> candidates,
                                const Turn& turn) const {
    PrimaryPaths& paths = paths_of_thread();
    group.points = {};
    const auto rays = look_at(
        era, paths, candidates.size(), [&](size_t i) { return candidates[i]; }, group.points, turn);
    if (!rays) return {};
    group.states.resize(candidates.size());
    for (size_t i = 0; i < candidates.size(); ++i) go(paths, i, group);
    return rays;
  }

  std::optional<uint64_t> mutate(const Era& era, Group& group, int index, int mutations, float scale,
                                 const Turn& turn) const {
    PrimaryPaths& paths = paths_of_thread();
    const uint64_t group_key = mix_bits(era.key ^ mix_bits(static_cast<uint64_t>(index) + 1));
    const Count count{scale, era, method_->combined ? double{method_->large_steps} : 0.0};
    std::array<Stay, PrimaryPaths::kLanes> stays;
    uint64_t rays = 0;
    for (int i = 0; i < mutations; ++i, ++group.mutations) {
      const uint64_t key = mix_bits(group_key + group.mutations);
      propose(group, key, paths, turn);
      const auto traced = paths.evaluate(pass_, *method_, plan_, era.law, group.states.size(), turn);
      if (!traced) return {};
      rays += *traced;
      const Stopwatch::Lap lap(turn.bookkeeping);
      for (size_t lane = 0; lane < group.states.size(); ++lane)
        decide(group, lane, key_of(key, lane), paths, stays[lane], count, *turn.splats);
    }
    const Stopwatch::Lap lap(turn.bookkeeping);
    for (size_t lane = 0; lane < group.states.size(); ++lane)
      count.record(group.states[lane].splats, group.states[lane].target, stays[lane].settle(), *turn.splats);
    return rays;
  }

 private:
  // What a state counts. By itself the chain's part is worth / target. Where large steps count as well, each takes the
  // share of its density: the chain that of target / worth, large steps that of theirs among all mutations (Kelemen et
  // al., section 3.2). How they share must not depend on what the candidates of this very era were worth: in
  // the first era, when nothing else is known, the chains alone count.
  struct Count {
    float scale;
    double worth, expected, large_steps;  // the last: share of all mutations, zero if they do not count

    Count(float s, const Era& era, double large)
        : scale(s), worth(era.worth), expected(era.expected()), large_steps(large) {}

    void record(const film::Splats& splats, float target, double iterations, film::Splats& to) const {
      if (!(target > 0) || !(iterations > 0)) return;
      const auto weight = static_cast<float>(iterations * worth / (double{target} + large_steps * expected)) * scale;
      for (const film::Splat& splat : splats) to.push_back({splat.pixel, splat.radiance * weight});
    }
  };

  static uint64_t key_of(uint64_t key, size_t lane) { return mix_bits(key + (lane + 1) * 0x9e3779b97f4a7c15ULL); }
  bool is_large(uint64_t lane_key) const { return unit_double(mix_bits(lane_key ^ 1)) < double{method_->large_steps}; }

  template <class NumberOf>
  std::optional<uint64_t> look_at(const Era& era, PrimaryPaths& paths, size_t count, NumberOf&& number_of,
                                  const PrimaryPoints& points, const Turn& turn) const {
    paths.proposals.begin(points, {method_->least_step, method_->step}, turn.bookkeeping);
    for (size_t i = 0; i < count; ++i) {
      paths.roots[i] = mix_bits(era.key + (number_of(i) + 1) * 0xd1342543de82ef95ULL);
      paths.proposals.propose(i, paths.roots[i], true);
    }
    return paths.evaluate(pass_, *method_, plan_, era.law, count, turn);
  }

  void propose(const Group& group, uint64_t key, PrimaryPaths& paths, const Turn& turn) const {
    const Stopwatch::Lap lap(turn.bookkeeping);
    paths.proposals.begin(group.points, {method_->least_step, method_->step}, turn.bookkeeping);
    for (size_t lane = 0; lane < group.states.size(); ++lane) {
      const uint64_t lane_key = key_of(key, lane);
      const bool large = is_large(lane_key);
      paths.roots[lane] = large ? lane_key : group.states[lane].root;
      paths.proposals.propose(lane, lane_key, large);
    }
  }

  void decide(Group& group, size_t lane, uint64_t lane_key, PrimaryPaths& paths, Stay& stay, const Count& count,
              film::Splats& splats) const {
    const bool large = is_large(lane_key);
    const PrimaryState& present = group.states[lane];
    const float target = paths.targets[lane];
    const Verdict verdict = judge(double{present.target}, double{target}, unit_double(mix_bits(lane_key ^ 2)));
    group.tally.kinds[large ? 0 : 1].count(verdict);
    stay.take(
        verdict, [&](double n) { count.record(present.splats, present.target, n, splats); },
        [&](double n) { count.record(paths.found[lane], target, n, splats); },
        large && method_->combined && target > 0 ? count.expected / count.worth : 0.0);
    if (verdict.accepted) go(paths, lane, group);
  }

  // The chain goes to its proposal.
  static void go(PrimaryPaths& paths, size_t lane, Group& group) {
    paths.proposals.accept(lane, group.points);
    PrimaryState& state = group.states[lane];
    state.root = paths.roots[lane], state.target = paths.targets[lane];
    std::swap(state.splats, paths.found[lane]);
  }

  const Pssmlt* method_;
  Pass pass_;
  BidirectionalPlan plan_;
};

}  // namespace

std::unique_ptr<Work> Pssmlt::begin(const Pass& pass, const Work*) const {
  return std::make_unique<ChainWork<PrimaryKernel>>(pass, PrimaryKernel(*this, pass));
}

}  // namespace etendue::integrator
