// What all methods of Markov chains share: seeding, chains that go side by side, what their states count, acceptance,
// and their state in checkpoints.                                                      thesis 9.4; digest: S23, S24
//
// Each half of the film has chains of its own, and one step of either is about as many mutations as the picture has
// pixels. The chains of a half are spread over groups, each of which is one task at a time; how many there are follows
// from the settings, never from the number of threads.
//
// Time goes in eras. Each begins with candidates of its own, from which its chains start, and the mean worth of these
// is what its states count by: so the mean of any era, of any length, is that of the picture. (Independent samples that
// came later would know the mean worth better, but are nothing to the chains that started: where few candidates are
// worth anything, the product of both would be too dark.) The next era begins once the mutations have taken ten
// times as long as the candidates, and draws as many as all before it: a tenth of the time goes there, and the mean
// worth becomes surer as the picture does. An era whose candidates are all worth nothing leaves its steps black, as it
// must.
//
// Kernel says what a chain is:
//
//   struct Era;
//     integrator::Era or more: it may have a `law` that learns from candidates (technique_law.h)
//   Era era() const;
//     the first one, before anything is known
//   struct Group;
//     some chains; copied, and has a ChainTally `tally`, void write(StateWriter&) const, bool read(StateReader&),
//     size_t memory() const
//   int chains() const, candidates() const;
//     of a half; the latter of its first era
//   static constexpr int kGroupSize;
//     256 if there is none
//   static constexpr uint64_t kMutationsPerCandidate;
//     of an era: as many as take ten times as long
//   static constexpr std::array<MutationKind, n> kKinds;
//   std::optional<uint64_t> weigh(const Era&, uint64_t first, const Candidates&, const Turn&) const;
//     the worth of candidates `first` and so on, independent of each other: contribution over density. Rays traced
//   std::optional<uint64_t> start(const Era&, Group&, int group, std::span<const uint64_t> starts, const Turn&) const;
//     lets one chain start at each of these candidates; what the group was before is gone, but for its tally
//   std::optional<uint64_t> mutate(const Era&, Group&, int group, int mutations, float scale, const Turn&) const;
//     advances every chain of a group by so many mutations. A state x counts `scale` times era.worth f / target(x) in
//     each iteration
//
// Everything random must follow from the era's key, the chain and what it has done.
#pragma once
#include <array>
#include <string>

#include "base/hash.h"
#include "film/film.h"
#include "integrator/integrator.h"
#include "integrator/markov_chain/chain_state.h"
#include "integrator/markov_chain/metropolis.h"
#include "integrator/markov_chain/seed_selection.h"

namespace etendue::integrator {

struct MutationKind {
  const char* name;  // "small-steps"
  const char* doc;
};

// Of a group, since its first start.
struct ChainTally {
  static constexpr size_t kMostKinds = 8;
  std::array<Acceptance, kMostKinds> kinds{};
};

// What the chains of a half have in common.
struct Epoch {
  uint64_t key = 0;          // random, the same for all eras
  uint64_t first = 0;        // of its candidates: there were as many in the eras before
  uint64_t drawn = 0;        // candidates, in all eras
  double weight = 0;         // mean of its candidates
  double worth_earlier = 0;  // sum of those before
  uint32_t since = 0;        // the step of the half that the first era began with
  bool started = false;      // there are chains

  // What was expected of `worth` before its candidates were drawn; zero in the first era.
  double expected() const { return first > 0 ? worth_earlier / static_cast<double>(first) : 0; }
};

// What is found out about candidates; their kinds are those that a law knows.
struct BootstrapSamples {
  std::span<float> weight;
  std::span<uint16_t> kinds;
};

template <class Kernel>
class MarkovChainRenderState final : public RenderState {
 public:
  static constexpr int kGroupSize = [] {
    if constexpr (requires { Kernel::kGroupSize; })
      return Kernel::kGroupSize;
    else
      return 256;
  }();

  MarkovChainRenderState(const RenderContext& context, Kernel kernel)
      : context_(context), kernel_(std::move(kernel)), halves_(film::kHalfBuffers, Half(kernel_.epoch())) {
    const int groups = (kernel_.chains() + kGroupSize - 1) / kGroupSize;
    for (Half& half : halves_) half.groups.resize(static_cast<size_t>(groups));
  }

  std::vector<Phase> phases(uint32_t sample) override {
    Half& half = half_of(sample);
    half.before = half.now, half.sample = sample;
    const uint32_t step = sample / film::kHalfBuffers;
    if (half.now.drawn == 0) open(half, sample);
    mutations_ = mutations_of(step);
    std::vector<Phase> list;
    seeding_ = is_over(half.now, step);
    if (seeding_) {
      worth_.assign(candidates_of(half.now), 0);
      if constexpr (kLearns) half.now.law.renew(), kinds_.assign(worth_.size(), 0);
      list.push_back({"seeding chains", static_cast<int>((worth_.size() + kGroupSize - 1) / kGroupSize)});
    }
    for (int done = 0; done < mutations_; done += kPart)
      list.push_back({"mutating", static_cast<int>(half.groups.size())});
    return list;
  }

  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const TaskContext& task_context) override {
    Half& half = half_of(sample);
    const auto index = static_cast<size_t>(task);
    if (seeding_ && phase == 0) return weigh(half, index, task_context);
    if (!half.now.started) return 0;
    const size_t part = phase - (seeding_ ? 1 : 0);
    return mutate(half, half.groups[index], task, part, task_context);
  }

  void finish(uint32_t sample, size_t phase) override {
    if (seeding_ && phase == 0) found_candidates(half_of(sample));
  }

  size_t memory() const override {
    size_t bytes = worth_.capacity() * sizeof(float) + kinds_.capacity() * sizeof(uint16_t);
    for (const Half& half : halves_)
      for (const Member& m : half.groups) bytes += m.now.memory() + m.before.memory();
    return bytes;
  }

  std::vector<Statistic> statistics() const override {
    std::array<Acceptance, ChainTally::kMostKinds> sums{};
    for (const Half& half : halves_)
      for (const Member& m : half.groups)
        for (size_t k = 0; k < Kernel::kKinds.size(); ++k) sums[k] += m.now.tally.kinds[k];
    std::vector<Statistic> list;
    for (size_t k = 0; k < Kernel::kKinds.size(); ++k) {
      const MutationKind& kind = Kernel::kKinds[k];
      if (sums[k].proposed == 0) continue;
      list.push_back({"accepted-" + std::string(kind.name),
                      100 * static_cast<double>(sums[k].accepted) / static_cast<double>(sums[k].proposed), "%",
                      kind.doc});
    }
    return list;
  }

  std::vector<std::byte> state(uint32_t sample) const override {
    StateWriter out;
    out.value(kLayout);
    for (const Half& half : halves_) {
      const bool running = half.sample == sample;
      out.value(running ? half.before : half.now);
      out.value<uint64_t>(half.groups.size());
      for (const Member& m : half.groups) (m.sample == sample ? m.before : m.now).write(out);
    }
    return out.take();
  }

  bool restore(std::span<const std::byte> state) override {
    StateReader in(state);
    uint64_t layout = 0;
    if (!in.value(layout) || layout != kLayout) return false;
    auto halves = halves_;
    for (Half& half : halves) {
      uint64_t groups = 0;
      if (!in.value(half.now) || !in.value(groups) || groups != half.groups.size()) return false;
      for (Member& m : half.groups)
        if (!m.now.read(in)) return false;
    }
    if (!in.at_end()) return false;
    halves_ = std::move(halves);
    return true;
  }

 private:
  using Group = typename Kernel::Group;
  using Epoch = typename Kernel::Epoch;
  static constexpr bool kLearns = requires(Epoch epoch) { epoch.law; };
  static constexpr uint64_t kLayout = 0x32534e4941484345;  // "ECHAINS2"
  // Mutations of a chain in one phase: what is found in between is kept in lists.
  static constexpr int kPart = 16;
  static constexpr uint64_t kMostCandidates = 1 << 22;  // of an era: its worths are kept in a list
  static constexpr uint32_t kNoSample = UINT32_MAX;

  struct Member {
    Group now, before;            // `before`: as it was before the sample
    uint32_t sample = kNoSample;  // the last one it took part in
    std::vector<uint64_t> starts;
  };
  struct Half {
    explicit Half(const Epoch& epoch) : now(epoch), before(epoch) {}

    Epoch now, before;
    uint32_t sample = kNoSample;
    std::vector<Member> groups;
  };

  Half& half_of(uint32_t sample) { return halves_[sample % film::kHalfBuffers]; }

  // The key knows the sample, so that a half that starts anew (a film goes on whose chains are lost) does not repeat
  // itself.
  void open(Half& half, uint32_t sample) {
    half.now.since = sample / film::kHalfBuffers;
    half.now.key = mix_bits(mix_bits(context_.seed + 0x3c6ef372fe94f82bULL) ^ sample);
  }

  // Before this step.
  bool is_over(const Epoch& epoch, uint32_t step) const {
    return uint64_t{step - epoch.since} * static_cast<uint64_t>(context_.width) *
               static_cast<uint64_t>(context_.height) >=
           Kernel::kMutationsPerCandidate * epoch.drawn;
  }

  // Of the next era.
  size_t candidates_of(const Epoch& epoch) const {
    const auto least = static_cast<uint64_t>(kernel_.candidates());
    return std::clamp(epoch.drawn, least, std::max(least, kMostCandidates));
  }

  // Of every chain; together as many as there are pixels, on average over the steps.
  int mutations_of(uint32_t step) const {
    const int64_t pixels = int64_t{context_.width} * context_.height, chains = kernel_.chains(), n = step;
    return static_cast<int>((n + 1) * pixels / chains - n * pixels / chains);
  }

  std::optional<uint64_t> weigh(const Half& half, size_t task, const TaskContext& task_context) {
    const size_t first = task * kGroupSize;
    const size_t count = std::min<size_t>(kGroupSize, worth_.size() - first);
    BootstrapSamples candidates{std::span(worth_).subspan(first, count), {}};
    if constexpr (kLearns) candidates.kinds = std::span(kinds_).subspan(first, count);
    return kernel_.weigh(half.now, half.now.drawn + first, candidates, task_context);
  }

  void found_candidates(Half& half) {
    Epoch& epoch = half.now;
    epoch.worth_earlier += epoch.weight * static_cast<double>(epoch.drawn - epoch.first);
    epoch.first = epoch.drawn, epoch.drawn += worth_.size();
    double sum = 0;
    for (const float w : worth_) sum += double{w};
    epoch.weight = sum / static_cast<double>(worth_.size());
    if constexpr (kLearns) epoch.law.note(worth_, kinds_);
    const double u = static_cast<double>(mix_bits(epoch.key ^ epoch.first) >> 11) * 0x1p-53;
    const auto starts = choose_starts(worth_, static_cast<size_t>(kernel_.chains()), u);
    // Neighbours in the list are alike: they are dealt out to the groups in turn.
    for (size_t i = 0; i < starts.size(); ++i)
      half.groups[i % half.groups.size()].starts.push_back(epoch.first + starts[i]);
    epoch.started = !starts.empty();
  }

  std::optional<uint64_t> mutate(Half& half, Member& m, int index, size_t part, const TaskContext& task_context) {
    const bool first = m.sample != half.sample;
    if (first) keep(m.now, m.before, task_context), m.sample = half.sample;
    // A task that was given up is done again.
    static thread_local Group kept;
    if (part > 0) keep(m.now, kept, task_context);
    const auto rays = move_on(half, m, index, part, task_context);
    if (!rays) m.now = part > 0 ? kept : m.before;
    if (rays) m.starts.clear();
    return rays;
  }

  static void keep(const Group& group, Group& kept, const TaskContext& task_context) {
    const Stopwatch::Lap lap(task_context.overhead_timer);
    kept = group;
  }

  std::optional<uint64_t> move_on(Half& half, Member& m, int index, size_t part, const TaskContext& task_context) {
    uint64_t rays = 0;
    if (!m.starts.empty()) {
      const auto started = kernel_.start(half.now, m.now, index, m.starts, task_context);
      if (!started) return {};
      rays += *started;
    }
    const int mutations = std::min(kPart, mutations_ - static_cast<int>(part) * kPart);
    const float scale = 1 / (static_cast<float>(kernel_.chains()) * static_cast<float>(mutations_));
    const auto mutated = kernel_.mutate(half.now, m.now, index, mutations, scale, task_context);
    if (!mutated) return {};
    return rays + *mutated;
  }

  const RenderContext context_;
  const Kernel kernel_;
  std::vector<Half> halves_;
  // Of the candidates that are being looked at.
  std::vector<float> worth_;
  std::vector<uint16_t> kinds_;
  int mutations_ = 0;  // of every chain in the running step
  bool seeding_ = false;
};

}  // namespace etendue::integrator
