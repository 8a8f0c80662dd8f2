// Ray casting                                                    [Lang, sec. 8.2, eq. 8.14-8.19, corrected; Appel 1968]
//
// Shows the first surface that a camera ray hits: its emission and, with the local illumination model, unshadowed
// direct light,
//
//    L  =  L_e  +  sum over lights j  f_s L_e,j |cos| / p_j
//
// with one point per light and visibility V = 1. The sampling of pixel centres in [Lang] corresponds to the center
// filter.
//
//   Paths         E[D|G]L; point lights: E(D|G)L
//   Bias          biased: no shadows, no indirect light
//   Cost          one ray per sample
//   Limitations   Indirect light and shadows are missing. Point lights need the local illumination model.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"

namespace etendue::integrator {

class RayCasting final : public CameraPathIntegrator<RayCasting> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "raycast",
        .label = "Ray casting",
        .summary = "The first surface along the camera ray, with unshadowed direct light or its emission alone",
        .group = Group::gathering,
        .paths = "E[D|G]L",
        .point_paths = "E(D|G)L",
        .bias = Bias::biased,
        .cost = "1 ray per sample",
        .limitations =
            "Indirect light and shadows are missing. Point lights have no effect without local illumination.",
        .accumulation = Accumulation::per_pixel,
        .shortcut = '1',
    };
  }

  Toggle local{"local", "Local illumination", true, "Adds direct light without shadows. Off: emission only"};

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
      if (local && !at_max_depth(1)) add_direct_light(paths, lights.value, {}, Shadows::ignored);
    }
  }
};

Registration ray_casting() { return registration<RayCasting>(); }

}  // namespace etendue::integrator
