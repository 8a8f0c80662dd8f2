// Path tracing with next event estimation.                        thesis 9.1.2, (9.26)-(9.29); Kajiya 1986
//
// Estimates L = L_e + T L by one random walk per sample from the camera. At every vertex the direct light is estimated
// twice, by a point on a light and by the direction the walk takes next, and both are combined by multiple importance
// sampling (thesis 6.6.9).
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"

namespace etendue::integrator {

class PathTracing final : public CameraPathIntegrator<PathTracing> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "path",
        .label = "Path tracing",
        .summary = "Random walks from the camera with direct light at every vertex",
        .group = Group::gathering,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G)L",
        .bias = Bias::unbiased,
        .cost = "2 rays per vertex; no memory beyond the path",
        .limitations =
            "caustics of small lights: EDS+L is found only when a walk happens to end on the light; point lights "
            "behind "
            "glass: never",
        .accumulation = Accumulation::per_pixel,
        .shortcut = '4',
    };
  }

  Choice<transport::MisHeuristic> heuristic{"heuristic", "MIS heuristic", transport::MisHeuristic::power,
                                            "How light samples and BSDF samples share a path"};
  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::automatic, kLightsDoc};
  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto parameters() { return std::tie(max_depth, heuristic, lights, roulette_start); }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths) const {
    using namespace transport;
    while (paths.trace()) {
      add_environment(paths, heuristic, lights);
      while (paths.next_hits()) {
        add_emission(paths, heuristic, lights);
        if (at_max_depth(paths.length())) continue;
        add_direct_light(paths, lights, heuristic);
        sample_bsdf(paths, roulette_start);
      }
    }
  }
};

Registration path_tracing() { return registration<PathTracing>(); }

}  // namespace etendue::integrator
