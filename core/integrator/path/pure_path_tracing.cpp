// Pure path tracing.                                                        thesis 9.1.1, (9.1)-(9.9)
//
// A random walk from the camera that counts light only where it meets it. Emitters may reflect: the sum form (9.3) is
// used, not the product form that needs black emitters.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"

namespace etendue::integrator {

class PathPure final : public Gathering<PathPure> {
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
        .accumulation = Sampling::pixels,
        .shortcut = '3',
    };
  }

  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto knobs() { return std::tie(max_depth, roulette_start); }

  std::string obstacle(const Pass& pass) const override { return obstacle_to_meeting_lights(pass); }

  template <class M>
  void estimate(transport::Front<M>& front) const {
    using namespace transport;
    while (front.advance()) {
      add_environment(front);
      while (front.arrive()) {
        add_emission(front);
        if (!at_limit(front.length())) scatter(front, roulette_start);
      }
    }
  }
};

Registration pure_path_tracing() { return registration<PathPure>(); }

}  // namespace etendue::integrator
