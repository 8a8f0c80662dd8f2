// Classic ray tracing.                                 thesis 8.2.2, (8.24), (8.30)-(8.33), errata E3-E6; Whitted 1980
//
// At every vertex shadow rays towards the lights, and one ray along each mirror and refraction direction, weighted with
// its coefficient: nothing is chosen. Under point lights, from the centre of a pixel, the picture has no noise.
// Branches end on surfaces without deltas, where they carry too little, and at the longest path.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"
#include "transport/wavefront/branching_paths.h"

namespace etendue::integrator {

class Whitted final : public CameraPathIntegrator<Whitted> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "whitted",
        .label = "Ray tracing (Whitted)",
        .summary = "Direct light, seen directly and through every mirror and refraction",
        .group = Group::gathering,
        .paths = "ES*[D|G]L",
        .point_paths = "ES*(D|G)L",
        .bias = Bias::biased,
        .cost = "up to 2^depth rays, and 1 for each light at each vertex; a stack of branches",
        .limitations =
            "light between diffuse or glossy surfaces, caustics: exactly zero; chains of mirrors beyond depth or "
            "threshold",
        .accumulation = Accumulation::per_pixel,
        .shortcut = '2',
    };
  }

  // Rays that mirrors hold captive would go on for ever.
  Whitted() {
    max_depth.value = 16;
    max_depth.range = {1, 1000};
    max_depth.doc = "Path segments from camera to light: 1 is a light seen directly, 2 direct illumination";
  }

  Number<float> threshold{"threshold",
                          "Least intensity",
                          1e-3f,
                          {0, 1},
                          "Branches end when they carry less than this share of what they show: shorter trees, darker"};
  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::every, kLightsDoc};

  auto parameters() { return std::tie(max_depth, threshold, lights); }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths) const {
    using namespace transport;
    const auto carries_enough = [&](const PathState<typename M::Color>& path, int) {
      return max_component(path.throughput) * path.eta_scale >= threshold;
    };
    auto& tree = BranchingPaths<M>::on(paths);
    while (tree.trace()) {
      add_environment(paths);
      while (paths.next_hits()) {
        add_emission(paths);
        if (at_max_depth(paths.length())) continue;
        add_direct_light(paths, lights, {});
        tree.follow_deltas(0, 0, carries_enough);
      }
    }
  }
};

Registration whitted() { return registration<Whitted>(); }

}  // namespace etendue::integrator
