// The common part of Markov chain integrators: bootstrap, parallel chains, normalisation, acceptance statistics and
// checkpoints.                                                              [Lang, sec. 9.4; Veach and Guibas 1997]
//
// Each half-buffer has its own chains. One step of a half-buffer is about as many mutations as the image has pixels.
// Its chains are divided into groups, each of which is one task at a time; the number of groups follows from the
// parameters, never from the number of threads.
//
// Rendering is divided into epochs. Each epoch draws new bootstrap samples, starts its chains at some of them, and
// normalises its contributions by their mean weight b. So the expectation of every epoch, of any length, is the image.
// (Bootstrap samples of later epochs would estimate b better, but they are independent of the chains that run: where
// few bootstrap samples contribute, the product of both would be too dark.) The next epoch begins when the mutations
// have taken ten times as long as the bootstrap samples, and draws as many samples as all epochs before: a tenth of the
// time is spent on them, and b converges with the image. The steps of an epoch whose bootstrap samples are all zero are
// black.
//
// Kernel defines the chains:
//
//   struct Epoch;
//     integrator::Epoch or derived from it; it may have a `distribution` that learns from bootstrap samples
//     (technique_distribution.h)
//   Epoch epoch() const;
//     the initial one
//   struct Group;
//     some chains; copyable, with a ChainTally `tally`, void write(StateWriter&) const, bool read(StateReader&) and
//     size_t memory() const
//   int chains() const, candidates() const;
//     number of chains of a half-buffer, and of bootstrap samples of its first epoch
//   static constexpr int kGroupSize;
//     optional; 256 by default
//   static constexpr uint64_t kMutationsPerCandidate;
//     mutations of an epoch per bootstrap sample: as many as take ten times as long
//   static constexpr std::array<MutationKind, n> kKinds;
//   std::optional<uint64_t> evaluate_bootstrap(const Epoch&, uint64_t first, const BootstrapSamples&,
//                                              const TaskContext&) const;
//     computes the weights (contribution over density) of the independent samples from index `first` on; returns the
//     number of rays
//   std::optional<uint64_t> start(const Epoch&, Group&, int group, std::span<const uint64_t> seeds,
//                                 const TaskContext&) const;
//     starts one chain at each of these bootstrap samples; replaces the group except for its tally
//   std::optional<uint64_t> mutate(const Epoch&, Group&, int group, int mutations, float scale,
//                                  const TaskContext&) const;
//     advances every chain of a group by so many mutations. A state x counts `scale` times b f / f*(x) in each
//     iteration
//
// All random numbers must follow from the epoch's key, the chain and its state.
#pragma once
#include <array>
#include <string>

#include "base/hash.h"
#include "film/half_buffers.h"
#include "integrator/integrator.h"
#include "base/state_bytes.h"
#include "integrator/markov_chain/metropolis.h"
#include "integrator/markov_chain/seed_selection.h"

namespace etendue::integrator {

struct MutationKind {
  const char* name;  // "small-steps"
  const char* doc;
};

// Acceptance counts of a group since its first start.
struct ChainTally {
  static constexpr size_t kMaxKinds = 8;
  std::array<Acceptance, kMaxKinds> kinds{};
};

// The data that the chains of a half-buffer share.
struct Epoch {
  uint64_t key = 0;           // random, the same for all epochs
  uint64_t first = 0;         // index of its first bootstrap sample: the number of those in earlier epochs
  uint64_t drawn = 0;         // bootstrap samples in all epochs
  double mean_weight = 0;     // b: the mean weight of its bootstrap samples
  double earlier_weight = 0;  // sum of the weights in earlier epochs
  uint32_t first_step = 0;    // the step of the half-buffer at which the first epoch began
  bool started = false;       // chains exist

  // The mean weight in all earlier epochs: an estimate of b that does not depend on this epoch's bootstrap samples.
  // Zero in the first epoch.
  double expected_weight() const { return first > 0 ? earlier_weight / static_cast<double>(first) : 0; }
};

// The results of bootstrap samples; `kinds` are those of the kernel's distribution.
struct BootstrapSamples {
  std::span<float> weights;
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
      : context_(context), kernel_(std::move(kernel)), half_buffers_(film::kHalfBuffers, HalfBuffer(kernel_.epoch())) {
    const int groups = (kernel_.chains() + kGroupSize - 1) / kGroupSize;
    for (HalfBuffer& half_buffer : half_buffers_) half_buffer.groups.resize(static_cast<size_t>(groups));
  }

  std::vector<Phase> phases(uint32_t sample) override {
    HalfBuffer& half_buffer = half_buffer_of(sample);
    half_buffer.saved = half_buffer.current;
    half_buffer.sample = sample;
    const uint32_t step = sample / film::kHalfBuffers;
    if (half_buffer.current.drawn == 0) start_first_epoch(half_buffer, sample);
    mutations_ = mutations_in(step);
    std::vector<Phase> list;
    bootstrapping_ = epoch_is_over(half_buffer.current, step);
    if (bootstrapping_) {
      weights_.assign(bootstrap_count(half_buffer.current), 0);
      if constexpr (kHasDistribution) {
        half_buffer.current.distribution.update();
        kinds_.assign(weights_.size(), 0);
      }
      list.push_back({"seeding chains", static_cast<int>((weights_.size() + kGroupSize - 1) / kGroupSize)});
    }
    for (int done = 0; done < mutations_; done += kMutationsPerPhase)
      list.push_back({"mutating", static_cast<int>(half_buffer.groups.size())});
    return list;
  }

  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const TaskContext& task_context) override {
    HalfBuffer& half_buffer = half_buffer_of(sample);
    const auto index = static_cast<size_t>(task);
    if (bootstrapping_ && phase == 0) return evaluate_bootstrap(half_buffer, index, task_context);
    if (!half_buffer.current.started) return 0;
    const size_t part = phase - (bootstrapping_ ? 1 : 0);
    return mutate(half_buffer, half_buffer.groups[index], task, part, task_context);
  }

  void finish(uint32_t sample, size_t phase) override {
    if (bootstrapping_ && phase == 0) begin_epoch(half_buffer_of(sample));
  }

  size_t memory() const override {
    size_t bytes = weights_.capacity() * sizeof(float) + kinds_.capacity() * sizeof(uint16_t);
    for (const HalfBuffer& half_buffer : half_buffers_)
      for (const GroupState& group : half_buffer.groups) bytes += group.current.memory() + group.saved.memory();
    return bytes;
  }

  std::vector<Statistic> statistics() const override {
    std::array<Acceptance, ChainTally::kMaxKinds> sums{};
    for (const HalfBuffer& half_buffer : half_buffers_)
      for (const GroupState& group : half_buffer.groups)
        for (size_t k = 0; k < Kernel::kKinds.size(); ++k) sums[k] += group.current.tally.kinds[k];
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
    for (const HalfBuffer& half_buffer : half_buffers_) {
      const bool running = half_buffer.sample == sample;
      out.value(running ? half_buffer.saved : half_buffer.current);
      out.value<uint64_t>(half_buffer.groups.size());
      for (const GroupState& group : half_buffer.groups)
        (group.sample == sample ? group.saved : group.current).write(out);
    }
    return out.take();
  }

  bool restore(std::span<const std::byte> state) override {
    StateReader in(state);
    uint64_t layout = 0;
    if (!in.value(layout) || layout != kLayout) return false;
    auto half_buffers = half_buffers_;
    for (HalfBuffer& half_buffer : half_buffers) {
      uint64_t groups = 0;
      if (!in.value(half_buffer.current) || !in.value(groups) || groups != half_buffer.groups.size()) return false;
      for (GroupState& group : half_buffer.groups)
        if (!group.current.read(in)) return false;
    }
    if (!in.at_end()) return false;
    half_buffers_ = std::move(half_buffers);
    return true;
  }

 private:
  using Group = typename Kernel::Group;
  using Epoch = typename Kernel::Epoch;
  static constexpr bool kHasDistribution = requires(Epoch epoch) { epoch.distribution; };
  static constexpr uint64_t kLayout = 0x32534e4941484345;  // "ECHAINS2"
  // Mutations of a chain in one phase; it bounds the lists of splats between phases.
  static constexpr int kMutationsPerPhase = 16;
  static constexpr uint64_t kMaxBootstrapSamples = 1 << 22;  // of an epoch: their weights are stored
  static constexpr uint32_t kNoSample = UINT32_MAX;

  struct GroupState {
    Group current, saved;         // `saved`: as before the sample
    uint32_t sample = kNoSample;  // the last one that it took part in
    std::vector<uint64_t> seeds;
  };
  struct HalfBuffer {
    explicit HalfBuffer(const Epoch& epoch) : current(epoch), saved(epoch) {}

    Epoch current, saved;
    uint32_t sample = kNoSample;
    std::vector<GroupState> groups;
  };

  HalfBuffer& half_buffer_of(uint32_t sample) { return half_buffers_[sample % film::kHalfBuffers]; }

  // The key depends on the sample, so that a half-buffer whose chains were lost does not repeat itself when rendering
  // is resumed.
  void start_first_epoch(HalfBuffer& half_buffer, uint32_t sample) {
    half_buffer.current.first_step = sample / film::kHalfBuffers;
    half_buffer.current.key = mix_bits(mix_bits(context_.seed + 0x3c6ef372fe94f82bULL) ^ sample);
  }

  // Whether the epoch ends before this step.
  bool epoch_is_over(const Epoch& epoch, uint32_t step) const {
    return uint64_t{step - epoch.first_step} * static_cast<uint64_t>(context_.width) *
               static_cast<uint64_t>(context_.height) >=
           Kernel::kMutationsPerCandidate * epoch.drawn;
  }

  // The number of bootstrap samples of the next epoch.
  size_t bootstrap_count(const Epoch& epoch) const {
    const auto min_count = static_cast<uint64_t>(kernel_.candidates());
    return std::clamp(epoch.drawn, min_count, std::max(min_count, kMaxBootstrapSamples));
  }

  // Mutations of every chain in a step; together as many as the image has pixels, on average over the steps.
  int mutations_in(uint32_t step) const {
    const int64_t pixels = int64_t{context_.width} * context_.height, chains = kernel_.chains(), n = step;
    return static_cast<int>((n + 1) * pixels / chains - n * pixels / chains);
  }

  std::optional<uint64_t> evaluate_bootstrap(const HalfBuffer& half_buffer, size_t task,
                                             const TaskContext& task_context) {
    const size_t first = task * kGroupSize;
    const size_t count = std::min<size_t>(kGroupSize, weights_.size() - first);
    BootstrapSamples candidates{std::span(weights_).subspan(first, count), {}};
    if constexpr (kHasDistribution) candidates.kinds = std::span(kinds_).subspan(first, count);
    return kernel_.evaluate_bootstrap(half_buffer.current, half_buffer.current.drawn + first, candidates, task_context);
  }

  void begin_epoch(HalfBuffer& half_buffer) {
    Epoch& epoch = half_buffer.current;
    epoch.earlier_weight += epoch.mean_weight * static_cast<double>(epoch.drawn - epoch.first);
    epoch.first = epoch.drawn;
    epoch.drawn += weights_.size();
    double sum = 0;
    for (const float w : weights_) sum += double{w};
    epoch.mean_weight = sum / static_cast<double>(weights_.size());
    if constexpr (kHasDistribution) epoch.distribution.add_weights(weights_, kinds_);
    const double u = static_cast<double>(mix_bits(epoch.key ^ epoch.first) >> 11) * 0x1p-53;
    const auto seeds = select_seeds(weights_, static_cast<size_t>(kernel_.chains()), u);
    // Successive seeds may be equal: they are distributed over the groups in turn.
    for (size_t i = 0; i < seeds.size(); ++i)
      half_buffer.groups[i % half_buffer.groups.size()].seeds.push_back(epoch.first + seeds[i]);
    epoch.started = !seeds.empty();
  }

  std::optional<uint64_t> mutate(HalfBuffer& half_buffer, GroupState& group, int index, size_t part,
                                 const TaskContext& task_context) {
    const bool first = group.sample != half_buffer.sample;
    if (first) {
      save(group.current, group.saved, task_context);
      group.sample = half_buffer.sample;
    }
    // A cancelled task is repeated.
    static thread_local Group backup;
    if (part > 0) save(group.current, backup, task_context);
    const auto rays = advance(half_buffer, group, index, part, task_context);
    if (!rays) group.current = part > 0 ? backup : group.saved;
    if (rays) group.seeds.clear();
    return rays;
  }

  static void save(const Group& group, Group& backup, const TaskContext& task_context) {
    const Stopwatch::Lap lap(task_context.overhead_timer);
    backup = group;
  }

  std::optional<uint64_t> advance(HalfBuffer& half_buffer, GroupState& group, int index, size_t part,
                                  const TaskContext& task_context) {
    uint64_t rays = 0;
    if (!group.seeds.empty()) {
      const auto started = kernel_.start(half_buffer.current, group.current, index, group.seeds, task_context);
      if (!started) return {};
      rays += *started;
    }
    const int mutations = std::min(kMutationsPerPhase, mutations_ - static_cast<int>(part) * kMutationsPerPhase);
    const float scale = 1 / (static_cast<float>(kernel_.chains()) * static_cast<float>(mutations_));
    const auto mutated = kernel_.mutate(half_buffer.current, group.current, index, mutations, scale, task_context);
    if (!mutated) return {};
    return rays + *mutated;
  }

  const RenderContext context_;
  const Kernel kernel_;
  std::vector<HalfBuffer> half_buffers_;
  // Results of the bootstrap samples of the running phase.
  std::vector<float> weights_;
  std::vector<uint16_t> kinds_;
  int mutations_ = 0;  // of every chain in the running step
  bool bootstrapping_ = false;
};

}  // namespace etendue::integrator
