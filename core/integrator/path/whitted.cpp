// Classic ray tracing                             [Lang, sec. 8.3, eq. 8.24-8.26, 8.30-8.33, corrected; Whitted 1980]
//
// At every vertex: direct light by shadow rays to all lights, and one ray along each mirror and refraction direction,
// weighted by its reflectance or transmittance:
//
//    L(x)  =  L_e  +  sum over lights  f_s L_e |cos| V / p  +  R L(x, reflected)  +  T L(x, refracted)
//
// Nothing is chosen at random except points on area lights: under point lights, with rays through pixel centres, the
// image has no noise. A branch ends at a surface without specular components, below the contribution cutoff, or at the
// maximum path length.
//
//   Paths         ES*[D|G]L; point lights: ES*(D|G)L
//   Bias          biased: all other paths are missing
//   Cost          up to 2^depth rays per sample and one per light and vertex; a stack of branches
//   Limitations   Indirect light between diffuse or glossy surfaces and caustics are missing, as are sequences of
//                 mirrors beyond the maximum length or the cutoff.
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
        .summary = "Direct light, viewed directly and through mirrors and refractions",
        .group = Group::gathering,
        .paths = "ES*[D|G]L",
        .point_paths = "ES*(D|G)L",
        .bias = Bias::biased,
        .cost = "up to 2^depth rays per sample and 1 per light at each vertex; a stack of branches",
        .limitations =
            "Indirect light between diffuse or glossy surfaces and caustics are missing, as are sequences of mirrors "
            "beyond the maximum length or the cutoff.",
        .accumulation = Accumulation::per_pixel,
        .shortcut = '2',
    };
  }

  // A limit is required: rays between facing mirrors would never end.
  Whitted() {
    max_depth.value = 16;
    max_depth.range = {1, 1000};
    max_depth.doc = "Segments from camera to light: 1 is directly visible light, 2 direct illumination";
  }

  Number<float> threshold{"threshold",
                          "Contribution cutoff",
                          1e-3f,
                          {0, 1},
                          "Branches whose throughput is below this value end. Raising it is faster and darker"};
  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::every, kLightsDoc};

  auto parameters() { return std::tie(max_depth, threshold, lights); }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths) const {
    using namespace transport;
    const auto above_cutoff = [&](const PathState<typename M::Color>& path, int, const auto&, float) {
      return max_component(path.throughput) * path.eta_scale >= threshold;
    };
    auto& branches = BranchingPaths<M>::on(paths);
    while (branches.trace()) {
      add_environment(paths);
      while (paths.next_hits()) {
        add_emission(paths);
        if (at_max_depth(paths.length())) continue;
        add_direct_light(paths, lights.value, {});
        branches.follow_deltas(0, 0, above_cutoff);
      }
    }
  }
};

Registration whitted() { return registration<Whitted>(); }

}  // namespace etendue::integrator
