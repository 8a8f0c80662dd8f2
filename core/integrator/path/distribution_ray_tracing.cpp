// Distribution ray tracing                              [Lang, sec. 8.4, eq. 8.37, 8.44, corrected; Cook et al. 1984]
//
// A tree of rays from every camera ray. The first vertices branch into N rays each, later vertices into one:
//
//    L  ~  L_e  +  1/N  sum over k = 1..N  f_s(w_k) |cos| L(w_k) / p(w_k)
//
// With shadow rays, direct light is estimated by light sampling and by the branches, combined by multiple importance
// sampling. Without them [Lang, Example 6.44], branches count the light that they hit. With one branch at every vertex
// the samples are identical to those of `path` and `path-pure`. With `branching=first-rough` only the first vertex that is
// not specular branches, behind any number of mirrors and refractions: splitting.
//
//   Paths         E(D|G|S|V)*L; point lights: E.*(D|G|V)L with shadow rays, none without
//   Bias          none
//   Cost          the number of rays is the product of the branch counts, twice with shadow rays; a stack of branches
//   Limitations   The number of rays grows exponentially with the depth of branching, and the deepest contribute least.
//                 Caustics of small lights are noisy as in path tracing. Point lights behind glass are never found.
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"
#include "integrator/shared/direct_light_parameters.h"
#include "transport/wavefront/branching_paths.h"
#include "transport/wavefront/medium_light.h"
#include "transport/wavefront/subsurface_scattering.h"

namespace etendue::integrator {

// Where paths branch: at the first three vertices, or at the first vertex that is not specular (splitting).
enum class BranchingVertices : uint8_t { first, first_rough };

}  // namespace etendue::integrator

template <>
struct etendue::Options<etendue::integrator::BranchingVertices> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"first", "First vertices"}, {"first-rough", "First rough vertex (splitting)"}}};
};

namespace etendue::integrator {

class DistributionRayTracing final : public CameraPathIntegrator<DistributionRayTracing>, public DirectLightParameters {
 public:
  static constexpr bool kScatteringMedia = true;

  static IntegratorInfo info() {
    return {
        .name = "distribution",
        .label = "Distribution ray tracing",
        .summary = "Branching rays from the camera with direct light at every vertex",
        .group = Group::gathering,
        .paths = "E(D|G|S|V)*L",
        .point_paths = "E.*(D|G|V)L",
        .bias = Bias::unbiased,
        .cost = "per depth, the product of the branch counts up to it, twice with shadow rays; a stack of branches",
        .limitations =
            "The number of rays grows exponentially with the depth of branching, and the deepest contribute least. "
            "Caustics of small lights are noisy, as in path tracing. Point lights behind glass are never found.",
        .scattering_media = kScatteringMedia,
        .heterogeneous_media = true,
        .emitting_media = true,
        .subsurface = true,
    };
  }

  Number<int> branches_1{"branches-1", "Branches at the first vertex", 4, {1, 64}, kBranchesDoc};
  Number<int> branches_2{"branches-2", "Branches at the second vertex", 1, {1, 64}, kBranchesDoc};
  Number<int> branches_3{
      "branches-3",
      "Branches at the third vertex",
      1,
      {1, 64},
      "Later vertices have one. Raising it reduces noise and multiplies the cost of all later vertices"};
  Choice<BranchingVertices> branching{"branching", "Branching vertices", BranchingVertices::first,
                                      "First vertices: the first three. First rough vertex: the first one that is not "
                                      "specular, with the branches of the "
                                      "first vertex"};
  Toggle shadow_rays{"shadow-rays", "Shadow rays", true,
                     "Samples lights directly. Off: only emitters that a ray hits count"};
  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};

  auto parameters() {
    return std::tie(max_depth, branches_1, branches_2, branches_3, branching, shadow_rays, lights, heuristic, cutoff,
                    power, roulette_start);
  }

  std::string incompatibility(const RenderContext& context) const override {
    return shadow_rays ? std::string() : incompatibility_with_point_lights(context);
  }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths, LightSampling sampling) const {
    if (shadow_rays)
      estimate_with(paths, transport::Combination(direct_light_mis()), sampling);
    else
      estimate_with(paths, transport::Combination(), sampling);
  }

 private:
  static constexpr const char* kBranchesDoc =
      "Rays from this vertex. Raising it reduces noise and multiplies the cost of all later vertices";

  int branches_at(int vertex) const {
    if (branching == BranchingVertices::first_rough) return 1;
    return vertex == 1 ? branches_1 : vertex == 2 ? branches_2 : vertex == 3 ? branches_3 : 1;
  }

  template <class M>
  void estimate_with(transport::PathWavefront<M>& paths, const transport::Combination& combination,
                     LightSampling sampling) const {
    using namespace transport;
    auto& tree = BranchingPaths<M>::on(paths);
    MediumLight<M> media(paths, combination);
    while (tree.trace()) {
      const int branches = branches_at(paths.length());
      add_environment(paths, combination, sampling);
      media.add_emission_of_misses();
      while (paths.next_hits()) {
        media.add_emission_before_hits();
        add_emission(paths, combination, sampling);
        if (at_max_depth(paths.length())) continue;
        scatter_below_surface(paths);
        if (shadow_rays) add_direct_light(paths, sampling, combination, Shadows::cast, static_cast<float>(branches));
        if (shadow_rays) media.add_light_samples(static_cast<float>(branches));
        if (branching == BranchingVertices::first_rough)
          tree.split_first_rough(branches_1, roulette_start);
        else
          tree.branch(branches, roulette_start);
      }
    }
  }
};

Registration distribution_ray_tracing() { return registration<DistributionRayTracing>(); }

}  // namespace etendue::integrator
