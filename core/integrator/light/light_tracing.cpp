// Light tracing with next event estimation: contribution rays.   thesis 9.2.2, Remarks 9.10, 9.11; digest 8-10: S20
//
// At every vertex of a random walk from a light the camera is connected: the dual of path tracing. Accidental hits of
// the lens are not counted besides.
#include "integrator/registration.h"
#include "integrator/shared/light_path_estimators.h"
#include "integrator/shared/light_path_integrator.h"

namespace etendue::integrator {

class Light final : public Shooting<Light> {
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
        .accumulation = Sampling::only_splats,
        .shortcut = '5',
    };
  }

  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto knobs() { return std::tie(max_depth, roulette_start); }

  template <class M>
  void see_light(const Pass& pass, const typename LightWalks<M>::Start& start, Vec2 lens, uint32_t seed,
                 Splatter& splatter) const {
    integrator::see_light<M>(pass, start, lens, seed, splatter, [](auto&&...) { return 1.0f; });
  }

  template <class M>
  void estimate(const Pass& pass, LightWalks<M>& walks, transport::Front<M>& front, Splatter& splatter) const {
    using namespace transport;
    while (front.advance())
      while (front.arrive()) {
        if (front.length() == 1) walks.dim_first_vertices(front);
        if (at_limit(front.length())) continue;
        connect_to_camera(pass, walks, front, splatter, [](int, const auto&) { return 1.0f; });
        scatter(front, roulette_start, Transport::importance);
      }
  }
};

Registration light_tracing() { return registration<Light>(); }

}  // namespace etendue::integrator
