// Ray casting: what the camera sees, and a local illumination model without shadows.   thesis 8.2, (8.14)-(8.19),
// errata E3, E5
//
// Plain, a pixel shows the emission of what its ray meets. With the local model a point on each light is added, as if
// nothing stood between it and the surface. The thesis's one ray through the centre of each pixel is the centre filter.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"

namespace etendue::integrator {

class RayCasting final : public CameraPathIntegrator<RayCasting> {
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
        .accumulation = Accumulation::per_pixel,
        .shortcut = '1',
    };
  }

  Toggle local{"local", "Local illumination", true,
               "Light from every source, as if nothing stood in between (thesis 8.2)"};

  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::every, kLightsDoc};

  auto parameters() { return std::tie(max_depth, local, lights); }

  std::string incompatibility(const RenderContext& context) const override {
    return local ? std::string() : incompatibility_with_point_lights(context);
  }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths) const {
    using namespace transport;
    if (!paths.trace()) return;
    add_environment(paths);
    while (paths.next_hits()) {
      add_emission(paths);
      if (local && !at_max_depth(1)) add_direct_light(paths, lights, {}, Shadows::ignored);
    }
  }
};

Registration ray_casting() { return registration<RayCasting>(); }

}  // namespace etendue::integrator
