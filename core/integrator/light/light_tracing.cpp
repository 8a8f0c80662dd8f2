// Light tracing with next event estimation         [Lang, sec. 9.2.2, Remarks 9.10, 9.11; Arvo 1986; Dutré et al. 1993]
//
// Random paths from the lights. Every vertex x is connected to the camera; this is the adjoint of path tracing:
//
//    I_pixel  +=  Phi(x) f*(x) |cos| V d(raster) / d(area across the ray)
//
// averaged over as many light paths as the image has pixels. Hits of the lens are not counted, since connections find
// the same paths.
//
//   Paths         E[(D|G|V).*]L; point lights: E(D|G|V).*L
//   Bias          none for these paths
//   Cost          two rays per vertex, one image besides the film
//   Limitations   Surfaces viewed in mirrors or through glass are black.
//                 Views of a small part of the lit scene receive few paths.
#include "integrator/registration.h"
#include "integrator/shared/light_path_estimators.h"
#include "integrator/shared/light_path_integrator.h"

namespace etendue::integrator {

class LightTracing final : public LightPathIntegrator<LightTracing> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "light",
        .label = "Light tracing",
        .summary = "Random paths from the lights with every vertex connected to the camera",
        .group = Group::shooting,
        .paths = "E[(D|G|V).*]L",
        .point_paths = "E(D|G|V).*L",
        .bias = Bias::unbiased,
        .cost = "2 rays per vertex; one image besides the film",
        .limitations =
            "Surfaces viewed in mirrors or through glass are black. Views of a small part of the lit scene receive few "
            "paths.",
        .accumulation = Accumulation::splats_only,
        .division = {DivisionUnit::samples, false,
                     "A light path depends on the number of its sample only, and contributes to any pixel."},
        .shortcut = '5',
        .scattering_media = true,
        .heterogeneous_media = true,
        .emitting_media = true,
        .starts_in_media = true,
        .ignores_portals = true,
    };
  }

  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};

  auto parameters() { return std::tie(max_depth, roulette_start); }

  template <class M>
  void connect_light_to_camera(const RenderContext& context, const typename LightSubpaths<M>::Start& start, Vec2 lens,
                               uint32_t seed, Splatter& splatter) const {
    integrator::connect_light_to_camera<M>(context, start, lens, seed, splatter, [](auto&&...) { return 1.0f; });
  }

  template <class M>
  void estimate(const RenderContext& context, LightSubpaths<M>& subpaths, transport::PathWavefront<M>& paths,
                Splatter& splatter) const {
    using namespace transport;
    while (paths.trace())
      while (paths.next_hits()) {
        if (paths.length() == 1) subpaths.apply_range_window(paths);
        if (at_max_depth(paths.length())) continue;
        connect_to_camera(context, subpaths, paths, splatter, [](int, const auto&) { return 1.0f; });
        sample_bsdf(paths, roulette_start, TransportMode::importance);
      }
  }
};

Registration light_tracing() { return registration<LightTracing>(); }

}  // namespace etendue::integrator
