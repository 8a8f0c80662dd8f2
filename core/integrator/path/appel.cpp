// Ray casting with shadow rays.                                                  thesis 8.2.1, Fig. 8.8; Appel 1968
//
// Local illumination as in raycast.h, but a light counts only where nothing stands between it and the surface: direct
// light, and nothing else.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"

namespace etendue::integrator {

class Appel final : public Gathering<Appel> {
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

  auto knobs() { return std::tie(max_depth, lights); }

  template <class M>
  void estimate(transport::Front<M>& front) const {
    using namespace transport;
    while (front.advance()) {
      add_environment(front);
      while (front.arrive()) {
        add_emission(front);
        if (!at_limit(front.length())) add_direct_light(front, lights, {});
      }
    }
  }
};

Registration appel() { return registration<Appel>(); }

}  // namespace etendue::integrator
