// The target function of Markov chains in primary sample space, in the three forms of pssmlt.cpp.
#pragma once
#include "integrator/bdpt/bidirectional_sampler.h"
#include "integrator/pssmlt/primary_sample_paths.h"
#include "integrator/pssmlt/technique_distribution.h"
#include "sampling/primary_sample_sampler.h"

namespace etendue::integrator {

enum class PrimaryForm { path, bidirectional, multiplexed };

// Evaluates the proposals of a group of chains; one object per thread.
class PrimarySampleTarget {
 public:
  static constexpr size_t kLanes = PrimarySamplePoints::kLanes;

  PrimarySampleProposals proposals;
  std::array<uint64_t, kLanes> roots;       // of each point: the key of its last large step
  std::array<film::Splats, kLanes> splats;  // its contributions to pixels
  std::array<float, kLanes> targets;        // the luminance of their sum
  std::array<uint16_t, kLanes> kinds{};     // the set of techniques, in the multiplexed form

  // Evaluates the first `lanes` proposals. Returns the number of rays, or nothing if it was cancelled.
  std::optional<uint64_t> evaluate(const RenderContext& context, PrimaryForm form, const BidirectionalOptions& options,
                                   const TechniqueDistribution& distribution, size_t lanes,
                                   const TaskContext& task_context) {
    for (size_t i = 0; i < lanes; ++i) {
      splats[i].clear();
      // The low bits contain the lane, by which samplers select the point.
      const auto opacity_key = static_cast<uint32_t>(mix_bits(roots[i] + 0xa0761d6478bd642fULL) >> 32);
      seeds_[i] = (opacity_key & ~PrimarySampleProposals::kLaneMask) | static_cast<uint32_t>(i);
    }
    const auto rays = transport::with_scattering_model(*context.model, [&]<class M>(M) {
      return evaluate_with<M>(context, form, options, distribution, lanes, task_context);
    });
    if (!rays) return {};
    for (size_t i = 0; i < lanes; ++i) find_target(i);
    return rays;
  }

 private:
  static constexpr size_t kCamera = 0, kLight = 1, kBoth = 2;

  template <class M>
  std::optional<uint64_t> evaluate_with(const RenderContext& context, PrimaryForm form,
                                        const BidirectionalOptions& options,
                                        const TechniqueDistribution& distribution, size_t lanes,
                                        const TaskContext& task_context) {
    PrimarySamplePaths primary{&proposals.sampler(kCamera), &proposals.sampler(kLight), {seeds_.data(), lanes}};
    if (form == PrimaryForm::path) return evaluate_path<M>(context, options, primary, task_context);
    if (form == PrimaryForm::multiplexed) {
      choose_techniques(distribution, lanes);
      primary.techniques = techniques_;
    }
    static thread_local const auto sampler = std::make_unique<BidirectionalSampler<M>>();
    const auto rays = sampler->evaluate(context, options, primary, splats, task_context);
    if (!primary.techniques.empty()) apply_probabilities(lanes);
    return rays;
  }

  template <class M>
  std::optional<uint64_t> evaluate_path(const RenderContext& context, const BidirectionalOptions& options,
                                        const PrimarySamplePaths& primary, const TaskContext& task_context) {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    std::array<Vec2, kLanes> rasters;
    launch_primary_sample_paths(context, primary, task_context, paths, rasters, [](int) { return true; });
    estimate(options, paths);
    if (paths.cancelled()) return {};
    Splatter splatter(context, splats);
    const float area = ImagePlane(context).area();
    for (int i = 0; i < paths.size(); ++i)
      if (!is_black(paths.state(i).radiance))
        splatter.add(i, rasters[static_cast<size_t>(i)], paths.opacity_seed(i), paths.state(i).radiance * area);
    return paths.rays_traced();
  }

  // Path tracing with next event estimation, as in path/path_tracing.cpp.
  template <class M>
  static void estimate(const BidirectionalOptions& options, transport::PathWavefront<M>& paths) {
    using namespace transport;
    const auto sampling = LightSampling::compensated(LightStrategy::automatic);
    MediumLight<M> media(paths, options.heuristic);
    while (paths.trace()) {
      media.add_emission_of_misses();
      add_environment(paths, options.heuristic, sampling);
      while (paths.next_hits()) {
        media.add_emission_before_hits();
        add_emission(paths, options.heuristic, sampling);
        if (options.too_long(paths.length() + 1)) continue;
        add_direct_light(paths, sampling, options.heuristic);
        media.add_light_samples();
        sample_bsdf(paths, options.roulette_start);
      }
    }
  }

  void choose_techniques(const TechniqueDistribution& distribution, size_t lanes) {
    const auto& choices = proposals.blocks({seeds_.data(), lanes}, kBoth, 0).values;
    for (size_t i = 0; i < lanes; ++i) {
      const auto choice = distribution.choose(choices[i][0]);
      techniques_[i] = choice.techniques;
      kinds[i] = choice.kind;
      inverse_probability_[i] = 1 / choice.probability;
    }
  }
  void apply_probabilities(size_t lanes) {
    for (size_t i = 0; i < lanes; ++i)
      for (film::Splat& splat : splats[i]) splat.radiance *= inverse_probability_[i];
  }

  // Contributions that are not finite are discarded.
  void find_target(size_t lane) {
    float sum = 0;
    for (const film::Splat& splat : splats[lane]) sum += luminance(splat.radiance);
    if (!std::isfinite(sum) || !(sum > 0)) {
      splats[lane].clear();
      sum = 0;
    }
    targets[lane] = sum;
  }

  std::array<uint32_t, kLanes> seeds_;
  std::array<Technique, kLanes> techniques_;
  std::array<float, kLanes> inverse_probability_;
};

}  // namespace etendue::integrator
