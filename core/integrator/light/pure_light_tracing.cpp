// Pure light tracing                                                       [Lang, sec. 9.2.1, eq. 9.33-9.35, corrected]
//
// Random paths from the lights that count when they hit the lens of the camera; this is the adjoint of pure path
// tracing. With X_0 on the light and scattering at X_1 .. X_M,
//
//    I_pixel  +=  Phi prod over i of f*(X_i) |cos| / p(X_i -> X_i+1)   W_e(X_M+1)
//
// All pixels share the same paths. The adjoint BSDF is used: power does not change with the index of refraction as
// radiance does.
//
//   Paths         E(D|G|S|V)*L; point lights: E.*L
//   Bias          none
//   Cost          one ray per vertex, one image besides the film
//   Limitations   Noise grows with the inverse of the lens area. Pinhole and orthographic cameras receive no light.
#include "integrator/registration.h"
#include "integrator/shared/light_path_estimators.h"
#include "integrator/shared/light_path_integrator.h"

namespace etendue::integrator {

class PureLightTracing final : public LightPathIntegrator<PureLightTracing> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "light-pure",
        .label = "Pure light tracing",
        .summary = "Random paths from the lights that count when they hit the lens",
        .group = Group::shooting,
        .paths = "E(D|G|S|V)*L",
        .point_paths = "E.*L",
        .bias = Bias::unbiased,
        .cost = "1 ray per vertex; one image besides the film",
        .limitations =
            "Noise grows with the inverse of the lens area. Pinhole and orthographic cameras receive no light.",
        .accumulation = Accumulation::splats_only,
        .division = {DivisionUnit::samples, false,
                     "A light path depends on the number of its sample only, and contributes to any pixel."},
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

  std::string incompatibility(const RenderContext& context) const override {
    if (context.camera->can_be_hit()) return {};
    if (!context.camera->has_lens()) return "light paths cannot hit a pinhole camera: set camera.lens-radius above 0";
    return "light paths cannot hit this lens: use a perspective camera without a near plane";
  }

  template <class M>
  void connect_light_to_camera(const RenderContext&, const typename LightSubpaths<M>::Start&, Vec2, uint32_t,
                               Splatter&) const {}

  template <class M>
  void estimate(const RenderContext& context, LightSubpaths<M>& subpaths, transport::PathWavefront<M>& paths,
                Splatter& splatter) const {
    using namespace transport;
    const auto unweighted = [](auto&&...) { return 1.0f; };
    while (paths.trace()) {
      add_lens_hits_of_misses(context, subpaths, paths, splatter, unweighted);
      while (paths.next_hits()) {
        add_lens_hits_of_segments(context, subpaths, paths, splatter, unweighted);
        if (at_max_depth(paths.length())) continue;
        if (paths.length() == 1) subpaths.apply_range_window(paths);
        sample_bsdf(paths, roulette_start, TransportMode::importance);
      }
    }
  }
};

Registration pure_light_tracing() { return registration<PureLightTracing>(); }

}  // namespace etendue::integrator
