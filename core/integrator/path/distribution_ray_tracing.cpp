// Distribution ray tracing.                thesis 8.3.1, (8.37), (8.44), errata E5, E9; Cook, Porter & Carpenter 1984
//
// A tree of rays from every camera ray: so many branches at the first vertices, one at later ones, each with an equal
// share. With shadow rays the direct light at a vertex is found by a point on a light and by the branches, combined by
// multiple importance sampling; without them (thesis Example 6.44) branches count the light that they meet. With one
// branch everywhere the trees are the walks of `path` and of `path-pure`, sample by sample.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"
#include "transport/wavefront/branching_paths.h"

namespace etendue::integrator {

class DistributionRayTracing final : public CameraPathIntegrator<DistributionRayTracing> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "distribution",
        .label = "Distribution ray tracing",
        .summary = "Trees of rays from the camera with direct light at every vertex",
        .group = Group::gathering,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G)L",
        .bias = Bias::unbiased,
        .cost = "the product of the branches so far at every depth, twice with shadow rays; a stack of branches",
        .limitations =
            "rays grow exponentially with the depth that branches, and the deepest carry least; caustics of small "
            "lights "
            "as in path tracing; point lights behind glass: never",
    };
  }

  Number<int> branches_1{"branches-1", "Branches at the first vertex", 4, {1, 64}, kBranchesDoc};
  Number<int> branches_2{"branches-2", "At the second", 1, {1, 64}, kBranchesDoc};
  Number<int> branches_3{"branches-3", "At the third", 1, {1, 64}, "Later ones have one"};
  Toggle shadow_rays{"shadow-rays", "Shadow rays", true,
                     "Direct light from points on lights; without, only what rays meet counts (Example 6.44)"};
  Choice<LightStrategy> lights{"lights", "Lights", LightStrategy::automatic, kLightsDoc};
  Choice<transport::MisHeuristic> heuristic{"heuristic", "MIS heuristic", transport::MisHeuristic::power,
                                            "How light samples and BSDF samples share a path"};
  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto parameters() {
    return std::tie(max_depth, branches_1, branches_2, branches_3, shadow_rays, lights, heuristic, roulette_start);
  }

  std::string incompatibility(const RenderContext& context) const override {
    return shadow_rays ? std::string() : incompatibility_with_point_lights(context);
  }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths) const {
    if (shadow_rays)
      gather(paths, transport::Combination(heuristic));
    else
      gather(paths, transport::Combination());
  }

 private:
  static constexpr const char* kBranchesDoc =
      "Rays that go on from there: less noise, as many times the cost of all that follows";

  int branches_at(int vertex) const {
    return vertex == 1 ? branches_1 : vertex == 2 ? branches_2 : vertex == 3 ? branches_3 : 1;
  }

  template <class M>
  void gather(transport::PathWavefront<M>& paths, const transport::Combination& shared) const {
    using namespace transport;
    auto& tree = BranchingPaths<M>::on(paths);
    while (tree.trace()) {
      const int branches = branches_at(paths.length());
      add_environment(paths, shared, lights);
      while (paths.next_hits()) {
        add_emission(paths, shared, lights);
        if (at_max_depth(paths.length())) continue;
        if (shadow_rays) add_direct_light(paths, lights, shared, Shadows::cast, static_cast<float>(branches));
        tree.branch(branches, roulette_start);
      }
    }
  }
};

Registration distribution_ray_tracing() { return registration<DistributionRayTracing>(); }

}  // namespace etendue::integrator
