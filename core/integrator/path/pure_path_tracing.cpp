// Pure path tracing.                                                        thesis 9.1.1, (9.1)-(9.9)
//
// A random walk from the camera that counts light only where it meets it. Emitters may reflect: the sum form (9.3) is
// used, not the product form that needs black emitters.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"

namespace etendue::integrator {

class PurePathTracing final : public CameraPathIntegrator<PurePathTracing> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "path-pure",
        .label = "Pure path tracing",
        .summary = "Random walks from the camera that count light only where they meet it",
        .group = Group::gathering,
        .paths = "E(D|G|S)*L",
        .point_paths = "",
        .bias = Bias::unbiased,
        .cost = "1 ray per vertex; no memory beyond the path",
        .limitations =
            "small lights: noise grows as one over the root of their solid angle; point, spot and directional lights: "
            "never",
        .accumulation = Accumulation::per_pixel,
        .shortcut = '3',
    };
  }

  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto parameters() { return std::tie(max_depth, roulette_start); }

  std::string incompatibility(const RenderContext& context) const override {
    return incompatibility_with_point_lights(context);
  }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths) const {
    using namespace transport;
    while (paths.trace()) {
      add_environment(paths);
      while (paths.next_hits()) {
        add_emission(paths);
        if (!at_max_depth(paths.length())) sample_bsdf(paths, roulette_start);
      }
    }
  }
};

Registration pure_path_tracing() { return registration<PurePathTracing>(); }

}  // namespace etendue::integrator
