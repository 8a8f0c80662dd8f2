// Pure light tracing.                                              thesis 9.2.1, (9.33)-(9.35), errata E7, E18, E19
//
// A random walk from a light that counts when it falls onto the lens of the camera: the dual of pure path tracing. All
// pixels are made of the same walks. Scattering is the adjoint one: power is not compressed by refraction.
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
        .summary = "Random walks from the lights that count when they fall onto the lens",
        .group = Group::shooting,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*L",
        .bias = Bias::unbiased,
        .cost = "1 ray per vertex; a picture beside the film",
        .limitations =
            "the lens is small: noise grows as one over its area; through a pinhole or in a parallel projection: never",
        .accumulation = Accumulation::splats_only,
    };
  }

  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto parameters() { return std::tie(max_depth, roulette_start); }

  std::string incompatibility(const RenderContext& context) const override {
    if (context.camera->can_be_hit()) return {};
    if (!context.camera->has_lens()) return "no light can fall onto a pinhole: set camera.lens-radius";
    return "no light can fall onto this lens: take a perspective camera without a near plane";
  }

  template <class M>
  void see_light(const RenderContext&, const typename LightSubpaths<M>::Start&, Vec2, uint32_t, Splatter&) const {}

  template <class M>
  void estimate(const RenderContext& context, LightSubpaths<M>& walks, transport::PathWavefront<M>& paths,
                Splatter& splatter) const {
    using namespace transport;
    const auto all = [](int, const auto&) { return 1.0f; };
    while (paths.trace()) {
      escape_through_lens(context, walks, paths, splatter, all);
      while (paths.next_hits()) {
        pass_through_lens(context, walks, paths, splatter, all);
        if (at_max_depth(paths.length())) continue;
        if (paths.length() == 1) walks.dim_first_vertices(paths);
        sample_bsdf(paths, roulette_start, TransportMode::importance);
      }
    }
  }
};

Registration pure_light_tracing() { return registration<PureLightTracing>(); }

}  // namespace etendue::integrator
