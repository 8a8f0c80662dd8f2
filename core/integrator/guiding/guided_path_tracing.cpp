// Guided path tracing                                                                   [Müller et al. 2017; Müller 2019]
//
// Path tracing whose directions are sampled by a mixture of the BSDF and of the incident radiance that earlier samples
// have found:
//
//    L  ~  sum over i  beta_i ( w_l f_s L_e |cos| V / p_l  +  w f_s L_e |cos| / p ),      p = (1 - c) p_b + c p_g
//    beta_i = product of f_s |cos| / p over the vertices before x_i
//
// The first twelve vertices of a path are guided; later ones sample the BSDF.
//
// A binary tree divides space into regions. Each region stores the distribution p_g of directions as a quadtree, and the
// fraction c. They are learned in iterations of 2, 4, 8, ... samples; each iteration is guided by the one before. Light
// that next event estimation finds is left out of what is learned, as far as its MIS weights do so.
//
// With `product`, p_g is the density of the product of incident radiance and cosine (cosine_product.h)
// [Herholz et al. 2016]. It has less noise per sample; where the BSDF is diffuse this is the whole integrand. It also
// takes more time, and does not pay in the scenes that were measured (docs/results/integrators.md).
//
// Every sample is unbiased, whatever its guide is, and all samples count alike. A sample is guided by those before it
// only. Given these its expectation is the image, so different samples are uncorrelated, although they are not
// independent. The half-buffers are therefore uncorrelated too, and their difference measures the error, although both
// learn from all samples. Pixels cannot have different sample counts, because a count that depends on samples would
// depend on the guide.
//
// Russian roulette compares the light that a path is expected to find with the light that was expected at its first
// guided vertex [Vorba and Křivánek 2016], both from what was learned.
//
//   Paths         E(D|G|S)*L; point lights: E.*(D|G)L
//   Bias          none
//   Cost          two rays per vertex; 24 bytes per vertex of a sample; up to some ten MB for the guide
//   Limitations   The first samples are those of path tracing. Each vertex costs up to twice the time of path tracing,
//                 which does not pay where light sampling finds most light. Point lights behind glass are never found.
//                 Scattering media and wavelengths are not supported.
#include <algorithm>
#include <cmath>

#include "integrator/guiding/block_records.h"
#include "integrator/guiding/guided_sampling.h"
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"
#include "integrator/shared/light_learning.h"

namespace etendue::integrator {

class GuidedPathTracing final : public IntegratorBase<GuidedPathTracing> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "path-guided",
        .label = "Guided path tracing",
        .summary = "Path tracing whose directions follow the light that earlier samples have found",
        .group = Group::gathering,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G)L",
        .bias = Bias::unbiased,
        .cost = "2 rays per vertex; 24 bytes per vertex of a sample, some ten MB for what is learned",
        .limitations =
            "The first samples are those of path tracing, and each vertex costs more: it does not pay where light "
            "sampling finds most light. Point lights behind glass are never found.",
        .accumulation = Accumulation::per_image,
        .division = {DivisionUnit::none, false, "Every sample is guided by what all samples before it have found."},
    };
  }

  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::automatic, kLightsDoc};
  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             2,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};
  Number<float> fraction{
      "fraction",
      "Guided fraction",
      0,
      {0, 0.95f},
      "Fraction of directions that are sampled by what was learned, the others by the BSDF. 0: learned "
      "for each region"};

  Toggle product{
      "product", "Product with cosine", false,
      "Guides directions by the product of radiance and cosine. Off: by the radiance alone, which is faster"};

  using IntegratorBase::at_max_depth;

  auto parameters() { return std::tie(max_depth, lights, roulette_start, fraction, product); }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const final;
};

namespace {

using guiding::BlockRecords;
using guiding::RadianceGuide;

// Regions with more than c sqrt(n) records in an iteration of n samples are divided [Müller et al. 2017]. Of iterations
// longer than kFullyRecorded samples, random subsets of the paths are recorded, so that the number of records grows as
// sqrt(n), and the bound stays.
constexpr double kMostRecordsOfARegion = 4000;
constexpr uint32_t kFullyRecorded = 8;
// Of larger images, a random subset of about this many paths of each sample is recorded.
constexpr double kMostRecordedPaths = 1 << 20;
constexpr uint32_t kFirstIteration = 2;  // samples
// The guided fraction until it is learned. It is small, because the weights of a path whose guide is poor have a variance
// that grows exponentially with its length.
constexpr float kFirstFraction = 0.25f;

RadianceGuide initial_guide(const GuidedPathTracing& integrator, const scene::CompiledScene& scene) {
  const auto& bounds = scene.bounds();
  const Vec3 size = bounds.empty() ? Vec3(0) : bounds.max - bounds.min;
  const bool learns_fraction = integrator.fraction == 0;
  return {bounds.empty() ? Vec3(0) : bounds.min, size, learns_fraction,
          learns_fraction ? kFirstFraction : float{integrator.fraction}};
}

class GuidedState final : public RenderState {
 public:
  GuidedState(const GuidedPathTracing& integrator, const RenderContext& context)
      : integrator_(integrator),
        context_(context),
        learned_(learn_light_choice(context, light_sampling(), integrator.max_depth)),
        columns_((context.width + PixelBlock::kWidth - 1) / PixelBlock::kWidth),
        blocks_(static_cast<size_t>(columns_ * ((context.height + PixelBlock::kHeight - 1) / PixelBlock::kHeight))),
        progress_{initial_guide(integrator, *context.scene)} {}

  // The records of the sample before are added first.
  std::vector<Phase> phases(uint32_t sample) override {
    learns_ = recorded_sample_ != sample && recorded_sample_ != kNoSample;
    if (!learns_) recorded_sample_ = sample;
    sample_ = sample;
    added_.fill(false);
    if (!learns_) return {};
    return {{"learning the incident radiance", BlockRecords::kGroups}};
  }
  std::optional<uint64_t> run(uint32_t, size_t, int task, const TaskContext&) override {
    for (const BlockRecords& block : blocks_) block.add_to(progress_.guide, task);
    added_[static_cast<size_t>(task)] = true;
    return 0;
  }
  void finish(uint32_t sample, size_t) override {
    end_sample(progress_);
    for (BlockRecords& block : blocks_) block.clear();
    recorded_sample_ = sample;
    learns_ = false;
  }

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_model(*context_.model,
                                 [&]<class M>(M) { return sample_with<M>(block, radiance, task_context); });
  }

  size_t memory() const override {
    size_t bytes = progress_.guide.memory();
    for (const BlockRecords& block : blocks_) bytes += block.memory();
    return bytes;
  }
  std::vector<Statistic> statistics() const override {
    return {{"regions", static_cast<double>(progress_.guide.region_count()), "",
             "Regions of space with a distribution of directions of their own"}};
  }

  // What was learned, and the records of the blocks of the sample that has begun.
  std::vector<std::byte> state(uint32_t) const override {
    StateWriter out;
    out.value(kLayout);
    if (learns_) {
      Progress progress = progress_;
      for (int group = 0; group < BlockRecords::kGroups; ++group)
        if (!added_[static_cast<size_t>(group)])
          for (const BlockRecords& block : blocks_) block.add_to(progress.guide, group);
      end_sample(progress);
      write(out, progress, sample_, {});
    } else {
      write(out, progress_, recorded_sample_, blocks_);
    }
    return out.take();
  }
  bool restore(std::span<const std::byte> state) override {
    StateReader in(state);
    Progress progress = progress_;
    uint64_t layout = 0, count = 0;
    uint32_t recorded = 0;
    if (!in.value(layout) || layout != kLayout || !in.value(progress.learned) || !in.value(progress.iteration) ||
        !progress.guide.read(in) || !in.value(recorded) || !in.value(count) || (count != 0 && count != blocks_.size()))
      return false;
    std::vector<std::vector<guiding::Record>> records(count);
    for (auto& list : records)
      if (!in.list(list) || std::ranges::any_of(list, [&](const guiding::Record& r) {
            return r.region >= progress.guide.region_count();
          }))
        return false;
    if (!in.at_end()) return false;
    progress_ = std::move(progress);
    recorded_sample_ = recorded;
    for (size_t i = 0; i < count; ++i) blocks_[i].assign(records[i]);
    return true;
  }

 private:
  static constexpr uint64_t kLayout = 0x3145444955474345;  // "ECGUIDE1"
  static constexpr uint32_t kNoSample = UINT32_MAX;

  struct Progress {
    RadianceGuide guide;
    uint32_t learned = 0;                  // samples of this iteration
    uint32_t iteration = kFirstIteration;  // length of this iteration
  };

  // All records of a sample have been added.
  static void end_sample(Progress& progress) {
    if (++progress.learned < progress.iteration) return;
    progress.guide.end_iteration(static_cast<uint64_t>(
        kMostRecordsOfARegion * std::sqrt(static_cast<double>(std::min(progress.iteration, kFullyRecorded)))));
    progress.learned = 0;
    progress.iteration *= 2;
  }

  static void write(StateWriter& out, const Progress& progress, uint32_t recorded,
                    std::span<const BlockRecords> blocks) {
    out.value(progress.learned);
    out.value(progress.iteration);
    progress.guide.write(out);
    out.value(recorded);
    out.value<uint64_t>(blocks.size());
    for (const BlockRecords& block : blocks) out.list(std::span(block.records()));
  }

  // The fraction of paths that are recorded.
  float recorded_share() const {
    const double of_pixels = kMostRecordedPaths / (static_cast<double>(context_.width) * context_.height);
    const double of_samples = std::sqrt(static_cast<double>(kFullyRecorded) / progress_.iteration);
    return static_cast<float>(std::min(of_pixels, 1.0) * std::min(of_samples, 1.0));
  }

  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    static thread_local guiding::PathRecords<M> path_records;
    const PixelOrder order(block);
    launch_camera_paths(context_, block, order, task_context, paths);
    path_records.begin(recorded_share());
    estimate(paths, path_records);
    const auto rays = collect(paths, order, radiance);
    if (rays) keep_records(block, paths, path_records);
    return rays;
  }

  template <class M>
  void keep_records(const PixelBlock& block, transport::PathWavefront<M>& paths,
                    const guiding::PathRecords<M>& path_records) {
    static thread_local std::vector<guiding::Record> records;
    records.clear();
    path_records.collect(paths, progress_.guide, [](const guiding::Record& record) { records.push_back(record); });
    blocks_[static_cast<size_t>(block.y / PixelBlock::kHeight * columns_ + block.x / PixelBlock::kWidth)].assign(
        records);
  }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths, guiding::PathRecords<M>& records) const {
    using namespace transport;
    constexpr MisHeuristic kHeuristic = MisHeuristic::power;
    const auto sampling = light_sampling().with(learned_.get());
    guiding::GuidedSampling<M> guided(paths, progress_.guide, records, integrator_.product);
    while (paths.trace()) {
      records.separate_direct_light(paths);
      add_environment(paths, kHeuristic, sampling);
      while (paths.next_hits()) {
        add_emission(paths, kHeuristic, sampling);
        if (integrator_.at_max_depth(paths.length())) continue;
        guided.begin_hits();
        guided.add_direct_light(sampling);
        guided.sample_directions(integrator_.roulette_start);
      }
    }
  }

  LightSampling light_sampling() const { return LightSampling::compensated(integrator_.lights); }

  const GuidedPathTracing& integrator_;
  const RenderContext context_;
  const std::shared_ptr<const LearnedLightChoice> learned_;  // null: nothing to learn
  const int columns_;
  std::vector<BlockRecords> blocks_;  // of the recorded sample
  Progress progress_;
  uint32_t recorded_sample_ = kNoSample, sample_ = kNoSample;
  bool learns_ = false;                              // the phase of `sample_` has not ended
  std::array<bool, BlockRecords::kGroups> added_{};  // by task of the phase
};

}  // namespace

std::unique_ptr<RenderState> GuidedPathTracing::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<GuidedState>(*this, context);
}

Registration guided_path_tracing() { return registration<GuidedPathTracing>(); }

}  // namespace etendue::integrator
