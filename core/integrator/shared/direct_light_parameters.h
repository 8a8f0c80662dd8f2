// The parameters of direct light that is found by light sampling and BSDF sampling.
#pragma once
#include "base/parameter.h"
#include "integrator/shared/camera_path_integrator.h"
#include "transport/mis/direct_light_mis.h"

namespace etendue::integrator {

struct DirectLightParameters {
  Choice<transport::DirectLightHeuristic> heuristic{
      "heuristic", "MIS heuristic", transport::DirectLightHeuristic::power,
      "How light sampling and BSDF sampling are weighted. Partition: direct light from light samples only"};
  Number<float> cutoff{"cutoff",
                       "MIS cutoff",
                       0.5f,
                       {0, 1},
                       "Cutoff heuristic: the density, relative to the larger one, below which a sample does not "
                       "count. 0 is the balance heuristic, 1 the maximum heuristic"};
  Number<float> power{"power",
                      "MIS power",
                      2,
                      {0.25f, 16},
                      "Power heuristic: the exponent. Raising it favours the technique with the larger density. 1 is "
                      "the balance heuristic"};
  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::automatic, kLightsDoc};

  transport::DirectLightMis direct_light_mis(int light_samples = 1) const {
    transport::DirectLightMis mis(heuristic.value);
    mis.cutoff = cutoff;
    mis.power = power;
    mis.light_samples = light_samples;
    return mis;
  }
  // Light samples leave out what BSDF samples find well, except with heuristics whose weights do not fall with the
  // density.
  LightSampling light_sampling() const {
    using enum transport::DirectLightHeuristic;
    return heuristic == constant || heuristic == partition ? LightSampling(lights) : LightSampling::compensated(lights);
  }
};

}  // namespace etendue::integrator
