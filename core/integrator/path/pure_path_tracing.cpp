// Pure path tracing                                                        [Lang, sec. 9.1.1, eq. 9.1-9.9; Kajiya 1986]
//
// Estimates L = L_e + T L with one random path per sample. Light counts only where the path hits an emitter:
//
//    L  ~  sum over i  L_e(x_i -> x_i-1) prod over j < i of f_s(x_j) |cos| / p(x_j -> x_j+1)
//
// Emitters may reflect: the sum of eq. 9.3 is used, not the product form that assumes black emitters.
//
//   Paths         E(D|G|S|V)*L; point lights: none
//   Bias          none; Russian roulette on the throughput
//   Cost          one ray per vertex, no memory beyond the path
//   Limitations   Noise grows with the inverse root of the lights' solid angle.
//                 Point, spot and directional lights are never found.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"
#include "transport/wavefront/medium_light.h"
#include "transport/wavefront/subsurface_scattering.h"

namespace etendue::integrator {

class PurePathTracing final : public CameraPathIntegrator<PurePathTracing> {
 public:
  static constexpr bool kScatteringMedia = true, kSpectral = true;

  static IntegratorInfo info() {
    return {
        .name = "path-pure",
        .label = "Pure path tracing",
        .summary = "Random paths from the camera that count light only where they hit an emitter",
        .group = Group::gathering,
        .paths = "E(D|G|S|V)*L",
        .point_paths = "",
        .bias = Bias::unbiased,
        .cost = "1 ray per vertex; no memory beyond the path",
        .limitations =
            "Small lights are noisy: noise grows with the inverse root of their solid angle. Point, spot and "
            "directional lights are never found.",
        .accumulation = Accumulation::per_pixel,
        .shortcut = '3',
        .scattering_media = kScatteringMedia,
        .heterogeneous_media = true,
        .emitting_media = true,
        .subsurface = true,
        .ignores_portals = true,
        .spectral = kSpectral,
    };
  }

  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};

  auto parameters() { return std::tie(max_depth, roulette_start); }

  std::string incompatibility(const RenderContext& context) const override {
    return incompatibility_with_point_lights(context);
  }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths) const {
    using namespace transport;
    MediumLight<M> media(paths, Combination());
    while (paths.trace()) {
      add_environment(paths);
      media.add_emission_of_misses();
      while (paths.next_hits()) {
        media.add_emission_before_hits();
        add_emission(paths);
        if (at_max_depth(paths.length())) continue;
        scatter_below_surface(paths);
        sample_bsdf(paths, roulette_start);
      }
    }
  }
};

Registration pure_path_tracing() { return registration<PurePathTracing>(); }

}  // namespace etendue::integrator
