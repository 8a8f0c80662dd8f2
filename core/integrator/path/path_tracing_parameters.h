// The parameters of path tracing with next event estimation, besides the largest path length.
#pragma once
#include "integrator/shared/camera_path_integrator.h"
#include "transport/mis/mis.h"

namespace etendue::integrator {

struct PathTracingParameters {
  Choice<transport::MisHeuristic> heuristic{"heuristic", "MIS heuristic", transport::MisHeuristic::power,
                                            "How light sampling and BSDF sampling are weighted"};
  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::automatic, kLightsDoc};
  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};
  Toggle equiangular{"equiangular", "Equiangular sampling", true,
                     "In scattering media with point or spot lights: a further light sample per segment, close to the "
                     "light. Much less noise around lights; one more ray per segment"};
};

}  // namespace etendue::integrator
