// Ray casting: what the camera sees, and a local illumination model without shadows.   thesis 8.2, (8.14)-(8.19),
// errata E3, E5
//
// Plain, a pixel shows the emission of what its ray meets. With the local model a point on each light is added, as if
// nothing stood between it and the surface. The thesis's one ray through the centre of each pixel is the centre filter.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"

namespace etendue::integrator {

class Raycast final : public Gathering<Raycast> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "raycast",
        .label = "Ray casting",
        .summary = "The first surface a ray meets, lit without shadows or left to its own emission",
        .group = Group::gathering,
        .paths = "E[D|G]L",
        .point_paths = "E(D|G)L",
        .bias = Bias::biased,
        .cost = "1 ray per sample",
        .limitations = "everything indirect, every shadow; point lights are invisible without the local model",
        .accumulation = Sampling::pixels,
        .shortcut = '1',
    };
  }

  Toggle local{"local", "Local illumination", true,
               "Light from every source, as if nothing stood in between (thesis 8.2)"};

  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::every, kLightsDoc};

  auto knobs() { return std::tie(max_depth, local, lights); }

  std::string obstacle(const Pass& pass) const override {
    return local ? std::string() : obstacle_to_meeting_lights(pass);
  }

  template <class M>
  void estimate(transport::Front<M>& front) const {
    using namespace transport;
    if (!front.advance()) return;
    add_environment(front);
    while (front.arrive()) {
      add_emission(front);
      if (local && !at_limit(1)) add_direct_light(front, lights, {}, Shadows::ignored);
    }
  }
};

Registration ray_casting() { return registration<Raycast>(); }

}  // namespace etendue::integrator
