// What all methods of Markov chains share: seeding, chains that go side by side, what their states count, acceptance,
// and their state in checkpoints.                                                      thesis 9.4; digest: S23, S24
//
// Each half of the film has chains of its own, and one step of either is about as many mutations as the picture has
// pixels. The chains of a half are spread over groups, each of which is one task at a time; how many there are follows
// from the settings, never from the number of threads. A half whose candidates were all worth nothing stays black, and
// draws more of them with its next step.
//
// Kernel says what a chain is:
//
//   struct Group;            // some chains; copied, and has a ChainTally `tally`,
//                            // void write(StateWriter&) const, bool read(StateReader&), size_t memory() const
//   int chains() const, candidates() const;        // of a half
//   static constexpr int kGroupSize;               // 256 if there is none
//   static constexpr std::array<MutationKind, n> kKinds;
//   // The worth of candidates `first` and so on, independent of each other: contribution over density. Rays traced.
//   std::optional<uint64_t> weigh(const Era&, uint64_t first, std::span<float> worth, const Turn&) const;
//   // Lets one chain start at each of these candidates.
//   std::optional<uint64_t> start(const Era&, Group&, std::span<const uint64_t> candidates, const Turn&) const;
//   // Advances every chain of a group by so many mutations. A state x counts `scale` f / target(x) in each iteration,
//   // where `worth` is the mean worth of all candidates.
//   std::optional<uint64_t> mutate(const Era&, Group&, int group, int mutations, double worth, float scale, const
//   Turn&) const;
//
// Everything random must follow from the era's key, the chain and what it has done.
#pragma once
#include <array>
#include <string>

#include "base/hash.h"
#include "film/film.h"
#include "integrator/chain_starts.h"
#include "integrator/chain_state.h"
#include "integrator/integrator.h"
#include "integrator/metropolis.h"

namespace etendue::integrator {

struct MutationKind {
  const char* name;  // "small-steps"
  const char* doc;
};

// Of a group, since its start. `worth` is the sum over independent samples that its chains drew on their way: it goes
// on where the candidates left off.
struct ChainTally {
  static constexpr size_t kMostKinds = 8;
  std::array<Acceptance, kMostKinds> kinds{};
  double worth = 0;
  uint64_t samples = 0;
};

// What the chains of a half have in common from their start on.
struct Era {
  uint64_t key = 0;         // random
  uint64_t candidates = 0;  // drawn until now
  double worth = 0;         // sum of what they are worth
  uint32_t since = 0;       // the sample that they were first drawn for
  bool started = false;     // there are chains

  double mean_worth(double more, uint64_t samples) const {
    return (worth + more) / static_cast<double>(std::max<uint64_t>(candidates + samples, 1));
  }
};

template <class Kernel>
class ChainWork final : public Work {
 public:
  static constexpr int kGroupSize = [] {
    if constexpr (requires { Kernel::kGroupSize; })
      return Kernel::kGroupSize;
    else
      return 256;
  }();

  ChainWork(const Pass& pass, Kernel kernel) : pass_(pass), kernel_(std::move(kernel)) {
    const int groups = (kernel_.chains() + kGroupSize - 1) / kGroupSize;
    for (Half& half : halves_) half.groups.resize(static_cast<size_t>(groups));
  }

  std::vector<Phase> phases(uint32_t sample) override {
    Half& half = half_of(sample);
    half.before = half.now, half.sample = sample;
    if (half.now.candidates == 0) open(half, sample);
    mutations_ = mutations_of(sample / film::kReplicates);
    std::vector<Phase> list;
    seeding_ = !half.now.started;
    if (seeding_) {
      worth_.assign(static_cast<size_t>(kernel_.candidates()), 0);
      list.push_back({"seeding chains", (kernel_.candidates() + kGroupSize - 1) / kGroupSize});
    }
    for (int done = 0; done < mutations_; done += kPart)
      list.push_back({"mutating", static_cast<int>(half.groups.size())});
    note_worth(half);
    return list;
  }

  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const Turn& turn) override {
    Half& half = half_of(sample);
    const auto index = static_cast<size_t>(task);
    if (seeding_ && phase == 0) return weigh(half, index, turn);
    if (!half.now.started) return 0;
    const size_t part = phase - (seeding_ ? 1 : 0);
    return mutate(half, half.groups[index], task, part, turn);
  }

  void finish(uint32_t sample, size_t phase) override {
    if (seeding_ && phase == 0) found_candidates(half_of(sample));
  }

  size_t memory() const override {
    size_t bytes = worth_.capacity() * sizeof(float);
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
  static constexpr uint64_t kLayout = 0x31534e4941484345;  // "ECHAINS1"
  // Mutations of a chain in one phase: what is found in between is kept in lists.
  static constexpr int kPart = 16;
  static constexpr uint32_t kNoSample = UINT32_MAX;

  struct Member {
    Group now, before;            // `before`: as it was before the sample
    uint32_t sample = kNoSample;  // the last one it took part in
    std::vector<uint64_t> starts;
  };
  struct Half {
    Era now, before;
    uint32_t sample = kNoSample;
    std::vector<Member> groups;
    double worth = 0;  // the mean, as of the running step
  };

  Half& half_of(uint32_t sample) { return halves_[sample % film::kReplicates]; }

  // The key knows the sample, so that a half that starts anew (a film goes on whose chains are lost) does not repeat
  // itself.
  void open(Half& half, uint32_t sample) {
    half.now.since = sample;
    half.now.key = mix_bits(mix_bits(pass_.seed + 0x3c6ef372fe94f82bULL) ^ sample);
  }

  // Of every chain; together as many as there are pixels, on average over the steps.
  int mutations_of(uint32_t step) const {
    const int64_t pixels = int64_t{pass_.width} * pass_.height, chains = kernel_.chains(), n = step;
    return static_cast<int>((n + 1) * pixels / chains - n * pixels / chains);
  }

  void note_worth(Half& half) {
    ChainTally sum;
    for (const Member& m : half.groups) sum.worth += m.now.tally.worth, sum.samples += m.now.tally.samples;
    half.worth = half.now.mean_worth(sum.worth, sum.samples);
  }

  std::optional<uint64_t> weigh(const Half& half, size_t task, const Turn& turn) {
    const size_t first = task * kGroupSize;
    const auto part = std::span(worth_).subspan(first, std::min<size_t>(kGroupSize, worth_.size() - first));
    return kernel_.weigh(half.now, half.now.candidates + first, part, turn);
  }

  void found_candidates(Half& half) {
    Era& era = half.now;
    for (const float w : worth_) era.worth += double{w};
    const double u = static_cast<double>(mix_bits(era.key ^ era.candidates) >> 11) * 0x1p-53;
    const auto starts = choose_starts(worth_, static_cast<size_t>(kernel_.chains()), u);
    // Neighbours in the list are alike: they are dealt out to the groups in turn.
    for (size_t i = 0; i < starts.size(); ++i)
      half.groups[i % half.groups.size()].starts.push_back(era.candidates + starts[i]);
    era.candidates += worth_.size();
    era.started = !starts.empty();
    note_worth(half);
  }

  std::optional<uint64_t> mutate(Half& half, Member& m, int index, size_t part, const Turn& turn) {
    const bool first = m.sample != half.sample;
    if (first) keep(m.now, m.before, turn), m.sample = half.sample;
    // A task that was given up is done again.
    static thread_local Group kept;
    if (part > 0) keep(m.now, kept, turn);
    const auto rays = move_on(half, m, index, part, turn);
    if (!rays) m.now = part > 0 ? kept : m.before;
    if (rays) m.starts.clear();
    return rays;
  }

  static void keep(const Group& group, Group& kept, const Turn& turn) {
    const Stopwatch::Lap lap(turn.bookkeeping);
    kept = group;
  }

  std::optional<uint64_t> move_on(Half& half, Member& m, int index, size_t part, const Turn& turn) {
    uint64_t rays = 0;
    if (!m.starts.empty()) {
      const auto started = kernel_.start(half.now, m.now, m.starts, turn);
      if (!started) return {};
      rays += *started;
    }
    const int mutations = std::min(kPart, mutations_ - static_cast<int>(part) * kPart);
    const float scale = 1 / (static_cast<float>(kernel_.chains()) * static_cast<float>(mutations_));
    const auto mutated = kernel_.mutate(half.now, m.now, index, mutations, half.worth, scale, turn);
    if (!mutated) return {};
    return rays + *mutated;
  }

  const Pass pass_;
  const Kernel kernel_;
  std::array<Half, film::kReplicates> halves_;
  std::vector<float> worth_;  // of the candidates that are being looked at
  int mutations_ = 0;         // of every chain in the running step
  bool seeding_ = false;
};

}  // namespace etendue::integrator
