#include "integrator/mlt.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "integrator/mutation_chain.h"

namespace etendue::integrator {
namespace {

// Chains of one half of the film.
template <class M>
struct Half {
  struct Group {
    std::vector<ChainState<M>> chains, next;  // `next` becomes `chains` when the group's task is done
    std::vector<uint32_t> starts;             // candidates; empty once the chains have started
    MutationCounts counts;
  };
  std::vector<float> worth;  // of the candidates
  double mean = 0;           // of that, b
  uint64_t seed = 0;         // of all since chains were started the last time
  bool started = false;
  std::vector<Group> groups;
};

template <class M>
class Chains final : public Work {
 public:
  Chains(const Mlt& method, const Pass& pass)
      : method_(method), pass_(pass), plan_(plan_of(method, pass)), pixels_(pass.width * pass.height) {}

  std::vector<Phase> phases(uint32_t sample) override {
    const uint32_t step = sample / film::kReplicates;
    Half<M>& half = half_of(sample);
    std::vector<Phase> list;
    seeding_ = !half.started || step == 0 || std::has_single_bit(step);
    if (seeding_) {
      half.seed = mix_bits(mix_bits(pass_.seed * film::kReplicates + sample % film::kReplicates + kSalt) ^ step);
      half.worth.assign(number_of_candidates(step), 0);
      list.push_back({"seeding chains", tasks_for(half.worth.size())});
    }
    list.push_back({"mutating", groups()});
    return list;
  }

  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const Turn& turn) override {
    return seeding_ && phase == 0 ? seed(half_of(sample), task, turn) : mutate(half_of(sample), task, turn);
  }

  void finish(uint32_t sample, size_t phase) override {
    if (seeding_ && phase == 0) choose_starts(half_of(sample));
  }

  size_t memory() const override {
    size_t bytes = 0;
    for (const auto& half : halves_) {
      bytes += half.worth.capacity() * sizeof(float);
      for (const auto& group : half.groups)
        for (const auto& chain : group.chains)
          bytes += 2 * static_cast<size_t>(chain.path.edges()) * sizeof(PathVertex<M>);
    }
    return bytes;
  }

 private:
  static constexpr size_t kCandidatesOfTask = 512, kMostCandidates = size_t{1} << 22;
  static constexpr int kMostGroups = 32, kStepsBetweenQuestions = 256;
  static constexpr uint64_t kSalt = 0x9ae16a3b2f90404f;

  static MutationPlan plan_of(const Mlt& method, const Pass& pass) {
    // The largest move goes over five percent of the picture's area.
    const float widest = std::sqrt(0.05f * static_cast<float>(pass.width) * static_cast<float>(pass.height) / kPi);
    const Bounds& bounds = pass.scene->bounds();
    return {{method.bidirectional, method.lens, method.caustic, method.chain, method.subpath},
            EdgeCounts(method.max_depth),
            {0.1f, std::max(widest, 1.0f)},
            {1e-4f, 0.1f},
            std::max(glm::distance(bounds.min, bounds.max), 1e-3f)};
  }

  Half<M>& half_of(uint32_t sample) { return halves_[sample % film::kReplicates]; }
  uint32_t chains() const { return static_cast<uint32_t>(method_.chains.value); }
  int groups() const { return std::min(method_.chains.value, kMostGroups); }
  static int tasks_for(size_t candidates) {
    return static_cast<int>((candidates + kCandidatesOfTask - 1) / kCandidatesOfTask);
  }
  // In proportion to the steps that the chains will make.
  size_t number_of_candidates(uint32_t step) const {
    const size_t share = size_t{std::bit_floor(std::max(step, 1U))} * static_cast<size_t>(pixels_) / 8;
    const auto least = static_cast<size_t>(method_.candidates.value);
    return std::max(least, std::min(share, kMostCandidates));
  }

  static ChainRandom random_of_candidate(const Half<M>& half, size_t candidate) {
    return ChainRandom(half.seed ^ mix_bits(uint64_t{candidate} + 1));
  }

  std::optional<uint64_t> seed(Half<M>& half, int task, const Turn& turn) const {
    PathSpace<M> space(pass_);
    LightPath<M> path;
    const size_t first = static_cast<size_t>(task) * kCandidatesOfTask,
                 end = std::min(half.worth.size(), first + kCandidatesOfTask);
    for (size_t i = first; i < end; ++i) {
      if (i % kStepsBetweenQuestions == 0 && !(*turn.wanted)()) return {};
      ChainRandom random = random_of_candidate(half, i);
      const double worth = propose(plan_.counts, space, random, path);
      half.worth[i] = std::isfinite(worth) ? static_cast<float>(worth) : 0;
    }
    return space.take_rays();
  }

  // Each chain starts from a candidate, chosen by what it is worth: at equal distances along the sum of all.
  void choose_starts(Half<M>& half) const {
    const double sum = std::accumulate(half.worth.begin(), half.worth.end(), 0.0);
    half.mean = sum / static_cast<double>(half.worth.size());
    half.started = true;
    half.groups.assign(static_cast<size_t>(groups()), {});
    if (!(sum > 0)) return;
    const double shift = double{ChainRandom(half.seed).next()};
    size_t candidate = 0;
    double passed = double{half.worth[0]};
    for (uint32_t chain = 0; chain < chains(); ++chain) {
      const double target = (chain + shift) / chains() * sum;
      while (!(target < passed) && candidate + 1 < half.worth.size()) passed += double{half.worth[++candidate]};
      half.groups[chain % half.groups.size()].starts.push_back(static_cast<uint32_t>(candidate));
    }
    half.worth = {};
  }

  // The chains of a group at their first paths.
  void start(Half<M>& half, size_t group, PathSpace<M>& space) const {
    auto& [chains, next, starts, counts] = half.groups[group];
    chains.resize(starts.size());
    for (size_t i = 0; i < starts.size(); ++i) {
      ChainState<M>& chain = chains[i];
      chain.number = static_cast<uint32_t>(i * half.groups.size() + group);
      ChainRandom random = random_of_candidate(half, starts[i]);
      propose(plan_.counts, space, random, chain.path);
      chain.shape = shape_of(chain.path);
      chain.random = ChainRandom(~half.seed ^ mix_bits(uint64_t{chain.number} + 1));
    }
    starts.clear();
  }

  std::optional<uint64_t> mutate(Half<M>& half, int task, const Turn& turn) const {
    auto& group = half.groups[static_cast<size_t>(task)];
    ChainRunner<M> runner(pass_, plan_);
    if (!group.starts.empty()) start(half, static_cast<size_t>(task), runner.space());
    group.next = group.chains;
    MutationCounts counts = group.counts;
    const float scale = static_cast<float>(half.mean / pixels_);
    int steps = 0;
    for (ChainState<M>& chain : group.next) {
      const auto share = [&](uint64_t n) { return static_cast<int>(n * static_cast<uint64_t>(pixels_) / chains()); };
      for (int i = share(chain.number); i < share(chain.number + 1); ++i) {
        if (steps++ % kStepsBetweenQuestions == 0 && !(*turn.wanted)()) return {};
        runner.step(chain, chains(), half.seed, scale, counts, *turn.splats);
      }
      runner.leave(chain, scale, *turn.splats);
    }
    std::swap(group.chains, group.next);
    group.counts = counts;
    return runner.space().take_rays();
  }

  const Mlt& method_;
  const Pass pass_;
  const MutationPlan plan_;
  const int pixels_;
  bool seeding_ = false;
  std::array<Half<M>, film::kReplicates> halves_;
};

}  // namespace

std::unique_ptr<Work> Mlt::begin(const Pass& pass, const Work*) const {
  return transport::with_model(
      *pass.model, [&]<class M>(M) -> std::unique_ptr<Work> { return std::make_unique<Chains<M>>(*this, pass); });
}

}  // namespace etendue::integrator
