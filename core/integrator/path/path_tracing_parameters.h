// The parameters of path tracing with next event estimation, besides the largest path length.
#pragma once
#include "integrator/shared/camera_path_integrator.h"
#include "integrator/shared/direct_light_parameters.h"
#include "transport/wavefront/roulette.h"

namespace etendue::integrator {

struct PathTracingParameters : DirectLightParameters {
  Number<int> light_samples{
      "light-samples",
      "Light samples",
      1,
      {1, 64},
      "Shadow rays per vertex, or per light and vertex if all lights are sampled. Raising it reduces "
      "the noise of direct light; one more ray each"};
  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};
  Choice<transport::SurvivalRule> survival_rule{"survival-rule", "Survival probability",
                                                transport::SurvivalRule::throughput,
                                                "Throughput: the largest component of the throughput of the path. "
                                                "Constant: the same at every vertex. Albedo: the "
                                                "largest component of the last reflectance"};
  Number<float> survival{"survival",
                         "Constant survival",
                         0.8f,
                         {0.05f, 0.99f},
                         "Survival probability, if it is constant. Raising it makes paths longer and less noisy"};
  Number<float> least_survival{
      "least-survival",
      "Minimum survival",
      0,
      {0, 0.9f},
      "Lower bound of survival probabilities by throughput and by albedo. Raising it keeps more "
      "dim paths"};
  Toggle equiangular{"equiangular", "Equiangular sampling", true,
                     "In scattering media with point or spot lights: a further light sample per segment, close to the "
                     "light. Much less noise around lights; one more ray per segment"};

  auto path_parameters() {
    return std::tie(heuristic, cutoff, power, lights, light_samples, roulette_start, survival_rule, survival,
                    least_survival, equiangular);
  }

  transport::DirectLightMis mis() const { return direct_light_mis(light_samples); }
  transport::RouletteSettings roulette() const {
    transport::RouletteSettings roulette(roulette_start);
    roulette.rule = survival_rule;
    roulette.constant = survival;
    roulette.minimum = least_survival;
    return roulette;
  }
};

}  // namespace etendue::integrator
