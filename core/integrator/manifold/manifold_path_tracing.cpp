// Manifold path tracing                                                  [Hanika et al. 2015; Zeltner et al. 2020]
//
// Path tracing (path_tracing.cpp) with manifold next event estimation: it also connects vertices to lights by way of
// mirrors and smooth glass. From a vertex x that is not specular, a chain of specular events is started in a random
// direction towards a mirror or glass. Newton's method changes its direction until the chain ends at a sampled point y of a
// light:
//
//    L  +=  w f_s |cos| T L_e |cos_y| / ( p_A(y) |det dy/dw| ) * N
//
// T is the product of the specular coefficients, det dy/dw the determinant of the derivative of the end of the chain by
// its direction at x. N is the number of further walks until one of them finds the same chain again: an unbiased
// estimate of one over the probability of finding it. w is the weight of chains against BSDF samples, which find the same
// light. It falls with the number of walks that it takes to find the chain (walk_weights.h).
//
// Chains to area lights, point lights and directional lights are found; chains to the environment, which BSDF samples
// find more easily, are not. Smooth surfaces with normal maps, stochastic opacity or motion are passed by BSDF samples
// only.
//
//   Paths         E(D|G|S)*L; point lights: E.*(D|G)L, and E.*(D|G)S+L with up to max-chain specular events
//   Bias          none, up to chains that fewer than one walk in 65,536 finds
//   Cost          two rays per vertex; besides, ten to some hundred rays per walk, if there are mirrors or glass. A walk
//                 starts at the first vertex of a path that is not specular, and at one in four of those after it
//   Limitations   Walks cost time where light by way of mirrors and glass does not matter, and where lights are large.
//                 Glass of many flat facets has a chain for each of them, which are found one at a time.
//                 Where the environment has more than nine tenths of the power of all lights, no chain is sampled.
//                 Scattering media and wavelengths are not supported.
#include "integrator/manifold/manifold_light.h"
#include "integrator/registration.h"
#include "integrator/shared/camera_path_integrator.h"
#include "integrator/shared/light_learning.h"

namespace etendue::integrator {

class ManifoldPathTracing final : public IntegratorBase<ManifoldPathTracing> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "path-manifold",
        .label = "Manifold path tracing",
        .summary = "Path tracing that connects surfaces to lights by way of mirrors and smooth glass",
        .group = Group::gathering,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G)[S[S[S[S]]]]L",
        .bias = Bias::unbiased,
        .cost = "2 rays per vertex; with mirrors or glass 10 to some 100 rays per walk besides",
        .limitations =
            "Walks cost time where light by way of mirrors and glass does not matter, and where lights are large. "
            "Mirrors and glass with normal maps, opacity or motion are passed as in path tracing, as is all glass "
            "where the environment has nine tenths of the power.",
        .accumulation = Accumulation::per_pixel,
        .same_without_specular = "path",
    };
  }

  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};
  Number<int> max_chain{"max-chain",
                        "Max. specular chain",
                        4,
                        {1, manifold::ChainType::kMaxLength},
                        "Reflections and refractions between a surface and a light. A glass sphere needs 2, two "
                        "of them 4. Longer chains are found as in path tracing"};

  using IntegratorBase::at_max_depth;

  auto parameters() { return std::tie(max_depth, roulette_start, max_chain); }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const final;

  // Of point lights and directional lights, chains that pass other specular surfaces than casters are missing, and all
  // chains if none are sampled.
  SampledPaths sampled_paths(const scene::CompiledScene* scene) const final {
    if (scene && (!manifold::has_only_casters(*scene) || manifold::ChainTargets(*scene).empty()))
      return {"E(D|G|S)*L", "E.*(D|G)L"};
    std::string chain;
    for (int i = 0; i < max_chain; ++i) chain = "[S" + chain + ']';
    return {"E(D|G|S)*L", "E.*(D|G)" + chain + 'L'};
  }
};

namespace {

class ManifoldState final : public RenderState {
  static constexpr LightSampling kSampling = LightSampling::compensated(LightStrategy::automatic);

  // Returns the number of rays that walks have traced. Clang 16 does not instantiate it if it is defined after its use.
  template <class M>
  uint64_t estimate(transport::PathWavefront<M>& paths) const {
    using namespace transport;
    const auto sampling = kSampling.with(learned_.get());
    constexpr MisHeuristic mis = MisHeuristic::power;
    manifold::ManifoldLight<M> chains(paths, casters_, targets_, integrator_.max_chain, integrator_.max_depth);
    while (paths.trace()) {
      add_environment(paths, mis, sampling);
      while (paths.next_hits()) {
        add_emission_weighted(paths, [&](int hit) {
          const auto& path = paths.state_at(hit);
          return path.pdf == 0 ? chains.weight_of_emission(hit)
                               : emission_weight(path, paths.scene(), paths.point(hit), mis, sampling);
        });
        if (integrator_.at_max_depth(paths.length())) continue;
        add_direct_light(paths, sampling, mis);
        chains.add_light();
        sample_bsdf_and_record(paths, RouletteSettings(integrator_.roulette_start), TransportMode::radiance,
                               [&](int hit, const auto& s) { chains.scatter(hit, s); });
      }
    }
    return chains.rays();
  }

 public:
  ManifoldState(const ManifoldPathTracing& integrator, const RenderContext& context)
      : integrator_(integrator),
        context_(context),
        learned_(learn_light_choice(context, kSampling, integrator.max_depth)),
        casters_(*context.scene),
        targets_(*context.scene) {}

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_model(*context_.model, [&]<class M>(M) -> std::optional<uint64_t> {
      transport::PathWavefront<M>& paths = thread_wavefront<M>();
      const PixelOrder order(block);
      launch_camera_paths(context_, block, order, task_context, paths);
      const uint64_t walk_rays = estimate(paths);
      if (task_context.recorder) task_context.recorder->collect(paths.size());
      const auto rays = collect(paths, order, radiance);
      if (!rays) return {};
      return *rays + walk_rays;
    });
  }

  size_t memory() const override { return casters_.memory(); }

 private:
  const ManifoldPathTracing& integrator_;
  const RenderContext context_;
  const std::shared_ptr<const LearnedLightChoice> learned_;  // null: nothing to learn
  const manifold::SpecularCasters casters_;
  const manifold::ChainTargets targets_;
};

}  // namespace

std::unique_ptr<RenderState> ManifoldPathTracing::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<ManifoldState>(*this, context);
}

Registration manifold_path_tracing() { return registration<ManifoldPathTracing>(); }

}  // namespace etendue::integrator
