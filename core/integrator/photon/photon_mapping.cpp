// Photon mapping: photons stored before, looked up from the camera.       thesis 9.5.3, 9.5.4, (9.140)-(9.147); S36-S38
//
// Light paths are parted at the first vertex with a wide part (D_G, transport/lobe_split.h) that the camera sees, after
// any number of narrow ones (S_G):
//
//   E S_G* L                              met by the walk from the camera
//   E S_G* D_G L                   a      `direct`: all of it estimated from the global map
//   E S_G* D_G S_G+ L              c      `classic`: a by shadow rays, c from the caustics map, d by final gathering,
//   E S_G* D_G S_G* D_G (.)* L     d                 whose rays look up the global map where they arrive at D_G
//
// so that nothing is counted twice: gather rays never count a light that they meet (a, c). Where one is so short that
// the disc of a lookup would reach around the corner, a, c and d are found there as they are at the first vertex. A
// narrow gloss is lit by shadow rays and by its own rays, which share paths by multiple importance sampling.
//
// Each half of the film has photons of its own, so that its stated error knows how they fell. What it cannot know is
// bias: light is spread over the discs, lost at edges, and gathered from around curved surfaces. A map stays until
// something but the camera changes. Photons that stay are independent random numbers whatever the sampler, because a
// rendering that goes on after its first samples makes the same map again.
#include "integrator/integrator_base.h"
#include "integrator/photon/final_gather.h"
#include "integrator/photon/photon_emission.h"
#include "integrator/photon/photon_lookup.h"
#include "integrator/photon/photon_paths.h"
#include "integrator/registration.h"
#include "sampling/random.h"

namespace etendue::integrator {

enum class PhotonUse { direct, classic };

}  // namespace etendue::integrator

template <>
struct etendue::Options<etendue::integrator::PhotonUse> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"direct", "Look up what is seen"}, {"classic", "Shadow rays, caustics, final gathering"}}};
};

namespace etendue::integrator {

class PhotonMapping final : public IntegratorBase<PhotonMapping> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "photonmap",
        .label = "Photon mapping",
        .summary = "Photons stored where light arrives; the camera's walks look up how densely they lie",
        .group = Group::two_pass,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G).*L",
        .bias = Bias::biased,
        .cost =
            "before the first samples 2 to 4 rays per photon and 32 bytes for each that is stored, twice; then 2 + 2 "
            "gather rays per sample, with a lookup for each",
        .limitations =
            "however many samples: blurred caustics and contacts, blotches of too few photons; looked up directly also "
            "dark edges and leaks; glossy surfaces under the roughness limit see point lights only directly",
        .accumulation = Accumulation::per_image,
        .shortcut = '8',
    };
  }

  Choice<PhotonUse> mode{"mode", "Photons are", PhotonUse::classic,
                         "Looked up where the camera looks: fast and blotched; or where gather rays arrive"};
  Number<int> photons{"photons",
                      "Photons",
                      100'000,
                      {0, 100'000'000},
                      "That leave the lights for the global map. More: less bias and noise, more memory",
                      "",
                      Scale::logarithmic};
  Number<int> caustic_photons{"caustic-photons",
                              "Caustic photons",
                              100'000,
                              {0, 100'000'000},
                              "That leave the lights for the caustics map; only what meets something narrow stays",
                              "",
                              Scale::logarithmic};
  Number<int> nearest{"nearest",
                      "Photons in an estimate",
                      50,
                      {2, 100'000},
                      "The relative noise is one over the root of it; more: a wider disc, more blur",
                      "",
                      Scale::logarithmic};
  Number<float> beta{
      "beta",
      "Growth with photons",
      0,
      {0, 1},
      "Photons in an estimate grow as (photons / 100,000)^beta: between 0 and 1 both bias and noise fall "
      "as photons are added, at 2/3 fastest; at 0 noise stays, at 1 bias"};
  Number<float> radius{"radius",
                       "Largest radius",
                       0.1f,
                       {0, 1},
                       "No photon is taken from farther away, as a part of the scene's size; 0: no limit",
                       "",
                       Scale::logarithmic};
  Choice<photon::Kernel> kernel{"kernel", "Kernel", photon::Kernel::constant,
                                "Others weigh near photons more: sharper, noisier"};
  Number<float> roughness{"roughness",
                          "Narrow below roughness",
                          0.2f,
                          {0, 1},
                          "Glossy lobes below are followed by rays as mirrors are, others are estimated from photons"};
  Number<int> gather{"gather", "Gather rays", 2, {1, 256}, "Of each sample, from the first wide surface; classic only"};
  Number<float> near{"near",
                     "Gather again within",
                     0.02f,
                     {0, 1},
                     "Shorter gather rays look nothing up but gather again, as a part of the scene's size; more: "
                     "better corners, slower"};
  Toggle renew{"renew", "New photons for every sample", false,
               "Averages the blotches of many maps; the bias of one stays. What moves always gets new ones"};
  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto parameters() {
    return std::tie(max_depth, mode, photons, caustic_photons, nearest, beta, radius, kernel, roughness, gather, near,
                    renew, roulette_start);
  }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const final;

 private:
  transport::LobeSplit split() const { return transport::LobeSplit(roughness); }
  bool direct() const { return mode == PhotonUse::direct; }

  // In an estimate from a map of so many photons.
  NearestPhotons nearest_of(int emitted, float size) const {
    constexpr double kReference = 100'000;
    const double most = nearest * std::pow(emitted / kReference, double{beta});
    const float farthest = radius > 0 ? radius * size : kInfinity;
    return {static_cast<size_t>(std::clamp(most + 0.5, 2.0, 1e7)), sqr(farthest), kernel};
  }

  PhotonPlan plan(bool caustics) const {
    PhotonPlan plan;
    plan.photons = max_depth == 1 ? 0 : caustics ? caustic_photons : photons;
    plan.split = split();
    plan.caustics = caustics;
    plan.shortest = caustics ? 2 : 1;
    plan.longest = std::max(0, max_depth - 1);
    return plan;
  }

  class Maps;
};

// Of each half of the film, a global map and one of caustics.
class PhotonMapping::Maps final : public RenderState {
 public:
  Maps(const PhotonMapping& method, const RenderContext& context, const Maps* previous)
      : method_(method), context_(context), size_(2 * context.scene->bounds().radius()) {
    if (context.model->classes) join_.emplace(*context.model->paths);
    const bool reusable = previous && !renews() && !previous->renews() && previous->same_light(context);
    for (uint32_t half = 0; half < film::kHalfBuffers; ++half)
      for (const bool caustics : {false, true}) {
        if (caustics && (method.direct() || context.model->diffuse)) continue;
        auto& mine = emissions_[half][caustics];
        const PhotonPlan plan = method.plan(caustics);
        if (reusable) mine = previous->emissions_[half][caustics];
        if (!mine || !(mine->plan() == plan)) mine = std::make_shared<PhotonEmission>(plan, half);
      }
  }

  std::vector<Phase> phases(uint32_t sample) override {
    std::vector<Phase> phases;
    running_.clear();
    for (const auto& emission : emissions_[sample % film::kHalfBuffers]) {
      if (!emission) continue;
      if (renews()) emission->begin(emission->plan(), sample);
      if (emission->ready()) continue;
      emission->add_phases(phases);
      running_.push_back(emission.get());
    }
    return phases;
  }

  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const TaskContext& task_context) override {
    RenderContext context = at_shared_time(context_, sample);
    if (!renews()) context.sampler = &random_;
    return running_[phase / 2]->run(context, static_cast<PhotonEmission::Step>(phase % 2), task, task_context);
  }
  void finish(uint32_t, size_t phase) override {
    running_[phase / 2]->finish(static_cast<PhotonEmission::Step>(phase % 2));
  }

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_model(*context_.model,
                                 [&]<class M>(M) { return sample_with<M>(block, radiance, task_context); });
  }

  size_t memory() const override {
    size_t bytes = 0;
    for (const auto& half : emissions_)
      for (const auto& emission : half) bytes += emission ? emission->memory() : 0;
    return bytes;
  }

  std::shared_ptr<const std::vector<StoredPoint>> points() const override {
    auto points = std::make_shared<std::vector<StoredPoint>>();
    for (const auto& emission : emissions_[0])
      if (emission && emission->ready()) add_points(emission->map(), kMostPoints / 2, *points);
    return points;
  }

 private:
  // What moves needs photons of its own time.
  bool renews() const { return method_.renew || context_.model->moving; }

  bool same_light(const RenderContext& context) const {
    const transport::Model &a = *context_.model, &b = *context.model;
    return context.seed == context_.seed && a.diffuse == b.diffuse && a.wide == b.wide && a.media == b.media &&
           a.classes == b.classes && (!a.classes || a.paths->automaton() == b.paths->automaton()) &&
           context.scene->same_light(*context_.scene);
  }

  PhotonView view(uint32_t sample, bool caustics, const TaskContext& task_context) const {
    const auto& emission = emissions_[sample % film::kHalfBuffers][caustics];
    return {emission ? &emission->map() : nullptr, method_.split(), join_ ? &*join_ : nullptr, method_.max_depth,
            task_context.overhead_timer};
  }

  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) const {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    const PixelOrder order(block);
    launch_camera_paths(at_shared_time(context_, block.sample), block, order, task_context, paths);
    if (method_.direct()) {
      if (!estimate_directly(view(block.sample, false, task_context), task_context, paths)) return {};
      return collect(paths, order, radiance);
    }
    static thread_local const auto gatherer = std::make_unique<FinalGather<M>>();
    gatherer->begin({view(block.sample, false, task_context), method_.nearest_of(method_.photons, size_)},
                    {view(block.sample, true, task_context), method_.nearest_of(method_.caustic_photons, size_)},
                    method_.gather, method_.near * size_);
    if (!estimate_in_terms(task_context, *gatherer, paths)) return {};
    const auto rays = collect(paths, order, radiance);
    if (!rays || gatherer->cancelled()) return {};
    return *rays + gatherer->rays_traced();
  }

  // False if nobody wants it any more: lookups take a while.
  template <class M>
  bool estimate_directly(const PhotonView& view, const TaskContext& task_context,
                         transport::PathWavefront<M>& paths) const {
    using namespace transport;
    while (paths.trace()) {
      add_environment(paths, kPartsHeuristic);
      while (paths.next_hits()) {
        if (!should_continue(task_context)) return false;
        add_emission(paths, kPartsHeuristic);
        if (method_.at_max_depth(paths.length())) continue;
        add_light_by_parts(paths, view.split, LitParts::near_specular);
        add_nearest_photons(paths, view, method_.nearest_of(method_.photons, size_), 0);
        sample_bsdf(paths, method_.roulette_start, TransportMode::radiance, TakeNearSpecular{view.split});
      }
    }
    return true;
  }

  template <class M>
  bool estimate_in_terms(const TaskContext& task_context, FinalGather<M>& gatherer,
                         transport::PathWavefront<M>& paths) const {
    using namespace transport;
    const LobeSplit split = method_.split();
    while (paths.trace()) {
      add_environment(paths, kPartsHeuristic);
      while (paths.next_hits()) {
        if (!should_continue(task_context)) return false;
        add_emission(paths, kPartsHeuristic);
        if (method_.at_max_depth(paths.length())) continue;
        add_light_by_parts(paths, split, LitParts::both);
        gatherer.add_caustics(paths);
        gatherer.gather(context_, task_context, paths);
        sample_bsdf(paths, method_.roulette_start, TransportMode::radiance, TakeNearSpecular{split});
      }
    }
    return true;
  }

  const PhotonMapping& method_;
  const RenderContext context_;
  const float size_;  // of the scene
  const RandomSampler random_;
  std::optional<transport::ClassJoin> join_;
  std::array<std::array<std::shared_ptr<PhotonEmission>, 2>, film::kHalfBuffers> emissions_;
  std::vector<PhotonEmission*> running_;  // one for two phases
};

std::unique_ptr<RenderState> PhotonMapping::begin(const RenderContext& context, const RenderState* previous) const {
  return std::make_unique<Maps>(*this, context, dynamic_cast<const Maps*>(previous));
}

Registration photon_mapping() { return registration<PhotonMapping>(); }

}  // namespace etendue::integrator
