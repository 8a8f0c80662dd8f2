// Light tracing with next event estimation: contribution rays.   thesis 9.2.2, Remarks 9.10, 9.11; digest 8-10: S20
//
// At every vertex of a random walk from a light the camera is connected: the dual of path tracing. Accidental hits of
// the lens are not counted besides.
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
        .summary = "Random walks from the lights, each vertex of which is connected to the camera",
        .group = Group::shooting,
        .paths = "E[(D|G).*]L",
        .point_paths = "E(D|G).*L",
        .bias = Bias::unbiased,
        .cost = "2 rays per vertex; a picture beside the film",
        .limitations =
            "what the camera sees in mirrors and through glass: black; views of a small part of what is lit: few walks "
            "come by",
        .accumulation = Accumulation::splats_only,
        .shortcut = '5',
    };
  }

  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto parameters() { return std::tie(max_depth, roulette_start); }

  template <class M>
  void see_light(const RenderContext& context, const typename LightSubpaths<M>::Start& start, Vec2 lens, uint32_t seed,
                 Splatter& splatter) const {
    integrator::see_light<M>(context, start, lens, seed, splatter, [](auto&&...) { return 1.0f; });
  }

  template <class M>
  void estimate(const RenderContext& context, LightSubpaths<M>& walks, transport::PathWavefront<M>& paths,
                Splatter& splatter) const {
    using namespace transport;
    while (paths.trace())
      while (paths.next_hits()) {
        if (paths.length() == 1) walks.dim_first_vertices(paths);
        if (at_max_depth(paths.length())) continue;
        connect_to_camera(context, walks, paths, splatter, [](int, const auto&) { return 1.0f; });
        sample_bsdf(paths, roulette_start, TransportMode::importance);
      }
  }
};

Registration light_tracing() { return registration<LightTracing>(); }

}  // namespace etendue::integrator
