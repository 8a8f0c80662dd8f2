// Ray casting with shadow rays.                                                  thesis 8.2.1, Fig. 8.8; Appel 1968
//
// Local illumination as in raycast.h, but a light counts only where nothing stands between it and the surface: direct
// light, and nothing else.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"

namespace etendue::integrator {

class Appel final : public CameraPathIntegrator<Appel> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "appel",
        .label = "Ray casting with shadows (Appel)",
        .summary = "The first surface a ray meets, lit by what it sees of the lights",
        .group = Group::gathering,
        .paths = "E[D|G]L",
        .point_paths = "E(D|G)L",
        .bias = Bias::unbiased,
        .cost = "1 ray per sample and 1 for each light; no memory",
        .limitations = "everything indirect, mirrors and glass: black; narrow glossy lobes under large lights: noise",
    };
  }

  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::every, kLightsDoc};

  auto parameters() { return std::tie(max_depth, lights); }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths) const {
    using namespace transport;
    while (paths.trace()) {
      add_environment(paths);
      while (paths.next_hits()) {
        add_emission(paths);
        if (!at_max_depth(paths.length())) add_direct_light(paths, lights, {});
      }
    }
  }
};

Registration appel() { return registration<Appel>(); }

}  // namespace etendue::integrator
