// Ray casting with shadow rays                                                 [Lang, sec. 8.2, fig. 8.8; Appel 1968]
//
// Direct light at the first surface that a camera ray hits:
//
//    L  =  L_e  +  sum over lights j  f_s L_e,j |cos| V / p_j
//
// As ray casting (ray_casting.cpp) with local illumination, but shadow rays determine the visibility V.
//
//   Paths         E[D|G]L; point lights: E(D|G)L
//   Bias          none for these paths; all others are missing
//   Cost          one ray per sample and one per light, no memory
//   Limitations   Indirect light is missing; mirrors and glass are black.
//                 Narrow glossy lobes under large lights are noisy.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"

namespace etendue::integrator {

class Appel final : public CameraPathIntegrator<Appel> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "appel",
        .label = "Ray casting with shadows (Appel)",
        .summary = "The first surface along the camera ray, with shadowed direct light",
        .group = Group::gathering,
        .paths = "E[D|G]L",
        .point_paths = "E(D|G)L",
        .bias = Bias::unbiased,
        .cost = "1 ray per sample and 1 per light; no memory",
        .limitations =
            "Indirect light is missing; mirrors and glass are black. Narrow glossy lobes under large lights are noisy.",
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
        if (!at_max_depth(paths.length())) add_direct_light(paths, lights.value, {});
      }
    }
  }
};

Registration appel() { return registration<Appel>(); }

}  // namespace etendue::integrator
