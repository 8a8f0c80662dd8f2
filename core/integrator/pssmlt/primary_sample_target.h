// What points of primary sample space are worth: the three forms of pssmlt.h.
#pragma once
#include "integrator/bdpt/bidirectional_sampler.h"
#include "integrator/pssmlt/technique_distribution.h"
#include "sampling/primary_sample_sampler.h"

namespace etendue::integrator {

enum class PrimaryForm { path, bidirectional, multiplexed };

// One for each thread: what proposals of a group of chains find.
class PrimarySampleTarget {
 public:
  static constexpr size_t kLanes = PrimarySamplePoints::kLanes;

  PrimarySampleProposals proposals;
  std::array<uint64_t, kLanes> roots;      // of each point: the key of its last large step
  std::array<film::Splats, kLanes> found;  // what it brings to the picture
  std::array<float, kLanes> targets;       // and the luminance of that
  std::array<uint16_t, kLanes> kinds{};    // by which technique, in the multiplexed form

  // Of the first `lanes` proposals; the number of rays, or nothing if that was given up.
  std::optional<uint64_t> evaluate(const RenderContext& context, PrimaryForm form, const BidirectionalOptions& plan,
                                   const TechniqueDistribution& law, size_t lanes, const TaskContext& task_context) {
    for (size_t i = 0; i < lanes; ++i) {
      found[i].clear();
      // The lane's bits tell samplers whose numbers are asked for.
      const auto world = static_cast<uint32_t>(mix_bits(roots[i] + 0xa0761d6478bd642fULL) >> 32);
      seeds_[i] = (world & ~PrimarySampleProposals::kLaneMask) | static_cast<uint32_t>(i);
    }
    const auto rays = transport::with_model(
        *context.model, [&]<class M>(M) { return look<M>(context, form, plan, law, lanes, task_context); });
    if (!rays) return {};
    for (size_t i = 0; i < lanes; ++i) measure(i);
    return rays;
  }

 private:
  static constexpr size_t kCamera = 0, kLight = 1, kBoth = 2;

  template <class M>
  std::optional<uint64_t> look(const RenderContext& context, PrimaryForm form, const BidirectionalOptions& plan,
                               const TechniqueDistribution& law, size_t lanes, const TaskContext& task_context) {
    PrimarySamplePaths given{&proposals.sampler(kCamera), &proposals.sampler(kLight), {seeds_.data(), lanes}};
    if (form == PrimaryForm::path) return walk<M>(context, plan, given, task_context);
    if (form == PrimaryForm::multiplexed) choose_techniques(law, lanes), given.techniques = techniques_;
    static thread_local const auto walks = std::make_unique<BidirectionalSampler<M>>();
    const auto rays = walks->evaluate(context, plan, given, found, task_context);
    if (!given.techniques.empty()) weigh_techniques(lanes);
    return rays;
  }

  template <class M>
  std::optional<uint64_t> walk(const RenderContext& context, const BidirectionalOptions& plan,
                               const PrimarySamplePaths& given, const TaskContext& task_context) {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    std::array<Vec2, kLanes> rasters;
    launch_primary_sample_paths(context, given, task_context, paths, rasters, [](int) { return true; });
    estimate(plan, paths);
    if (paths.cancelled()) return {};
    Splatter splatter(context, found);
    const float area = Plane(context).area();
    for (int i = 0; i < paths.size(); ++i)
      if (!is_black(paths.state(i).radiance))
        splatter.add(i, rasters[static_cast<size_t>(i)], paths.opacity_seed(i), paths.state(i).radiance * area);
    return paths.rays_traced();
  }

  // Path tracing with next event estimation, as in path/path_tracing.cpp.
  template <class M>
  static void estimate(const BidirectionalOptions& plan, transport::PathWavefront<M>& paths) {
    using namespace transport;
    while (paths.trace()) {
      add_environment(paths, plan.heuristic);
      while (paths.next_hits()) {
        add_emission(paths, plan.heuristic);
        if (plan.too_long(paths.length() + 1)) continue;
        add_direct_light(paths, LightStrategy::automatic, plan.heuristic);
        sample_bsdf(paths, plan.roulette_start);
      }
    }
  }

  // The length stays as it is in between large steps.
  void choose_techniques(const TechniqueDistribution& law, size_t lanes) {
    const auto& choices = proposals.blocks({seeds_.data(), lanes}, kBoth, 0).values;
    for (size_t i = 0; i < lanes; ++i) {
      const auto length = to_unit_float(static_cast<uint32_t>(mix_bits(roots[i] + 0xe7037ed1a0b428dbULL) >> 32));
      const auto choice = law.choose(length, choices[i][0]);
      techniques_[i] = choice.technique, kinds[i] = choice.kind;
      over_probability_[i] = 1 / choice.probability;
    }
  }
  void weigh_techniques(size_t lanes) {
    for (size_t i = 0; i < lanes; ++i)
      for (film::Splat& splat : found[i]) splat.radiance *= over_probability_[i];
  }

  // What is no number is worth nothing.
  void measure(size_t lane) {
    float sum = 0;
    for (const film::Splat& splat : found[lane]) sum += luminance(splat.radiance);
    if (!std::isfinite(sum) || !(sum > 0)) found[lane].clear(), sum = 0;
    targets[lane] = sum;
  }

  std::array<uint32_t, kLanes> seeds_;
  std::array<Technique, kLanes> techniques_;
  std::array<float, kLanes> over_probability_;
};

}  // namespace etendue::integrator
