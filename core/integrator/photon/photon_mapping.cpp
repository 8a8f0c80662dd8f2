// Photon mapping                                   [Lang, sec. 9.5.3, eq. 9.140-9.147; Jensen 1996; Jensen 2001]
//
// A first pass stores photons where they hit surfaces; the second estimates reflected radiance from the photons in a
// disc of radius r around a point,
//
//    L_o  ~  1 / (pi r^2)  sum of f_s(w_photon, w_o) Phi
//
// Paths are divided at the first vertex with rough lobes (D_G, transport/wavefront/lobe_split.h) from the camera, after
// any number of near-specular ones (S_G):
//
//   E S_G* L                              the camera path hits the light
//   E S_G* D_G L                   a      `direct`: all three from the global map
//   E S_G* D_G S_G+ L              c      `classic`: a by shadow rays, c from the caustics map, d by final gathering
//   E S_G* D_G S_G* D_G (.)* L     d                 with global map lookups at the next D_G
//
// Nothing is counted twice, because gather rays do not count light that they hit (a, c). Where a gather ray is so short
// that the disc of a lookup would reach around a corner, a, c and d are estimated there as at the first vertex.
// Near-specular glossy lobes are lit by shadow rays and by BSDF sampling, combined by multiple importance sampling.
//
// In scattering media, collisions (V) are vertices like those of rough surfaces. Photons are stored at their collisions
// (photon_paths.h), and in-scattered radiance at the first collision of a camera path is estimated from the photons in
// a ball. `direct` takes all of it from the volume map. `classic` samples direct light (VL) and takes the rest from the
// map, without gather rays; on the segments of camera paths, point lights are sampled by equiangular distances as well.
// Gather rays that collide are estimated in the same way. Where a ball of the maximum radius would reach beyond the
// boundary at which a camera path has entered the medium, the path continues instead (shallow_collisions.h).
//
// Media that emit are seen directly on the segments of camera paths before gathering (E S_G* L). All other light of
// them comes from photons that start in media. The caustics map contains those of term a.
//
// Each half-buffer has its own photons, so that the error estimate includes their variance. It cannot include bias.
// Maps are reused until something other than the camera changes. Reused photons come from independent random numbers,
// whatever the sampler, because a resumed rendering must reproduce the same map.
//
//   Paths         E(D|G|S|V)*L; point lights: E.*(D|G|V).*L
//   Bias          biased: density estimation blurs light over the disc, darkens edges, and brightens curved surfaces;
//                 in media it blurs light over the ball
//   Cost          first 2 to 4 rays per photon and 34 bytes per stored photon (80 while they are sorted); then 2 + 2
//                 gather rays per sample with one lookup each
//   Limitations   Caustics and contact shadows are blurred, few photons show as blotches. Direct lookups darken edges
//                 and leak light. Near-specular surfaces receive point lights only directly.
#include "integrator/integrator_base.h"
#include "integrator/photon/direct_light_by_lobe.h"
#include "integrator/photon/emission_of_media.h"
#include "integrator/photon/final_gather.h"
#include "integrator/photon/photon_emission.h"
#include "integrator/photon/photon_lookup.h"
#include "integrator/photon/photon_paths.h"
#include "integrator/registration.h"
#include "sampling/random.h"

namespace etendue::integrator {

enum class PhotonUse { is_direct, classic };

}  // namespace etendue::integrator

template <>
struct etendue::Options<etendue::integrator::PhotonUse> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"direct", "Direct visualization"}, {"classic", "Final gathering"}}};
};

namespace etendue::integrator {

class PhotonMapping final : public IntegratorBase<PhotonMapping> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "photonmap",
        .label = "Photon mapping",
        .summary = "Photons stored in a first pass, looked up by density estimation from the camera",
        .group = Group::two_pass,
        .paths = "E(D|G|S|V)*L",
        .point_paths = "E.*(D|G|V).*L",
        .bias = Bias::biased,
        .cost =
            "first 2 to 4 rays per photon and 34 bytes per stored photon (80 while they are sorted); then 2 + 2 gather "
            "rays per sample with one lookup each",
        .limitations =
            "For any number of samples: caustics and contact shadows are blurred, few photons show as blotches. Direct "
            "visualization darkens edges and leaks light. Glossy surfaces below the roughness limit receive point "
            "lights only directly.",
        .accumulation = Accumulation::per_image,
        .division = {DivisionUnit::passes, true, "Each part traces the same photons again."},
        .shortcut = '8',
        .scattering_media = true,
        .heterogeneous_media = true,
        .emitting_media = true,
        .starts_in_media = true,
    };
  }

  Choice<PhotonUse> mode{"mode", "Mode", PhotonUse::classic,
                         "Direct visualization looks up photons at visible surfaces: fast, blotchy. Final gathering "
                         "looks them up where gather rays end"};
  Number<int> photons{"photons",
                      "Photons",
                      100'000,
                      {0, 100'000'000},
                      "Photons emitted for the global map. Raising it reduces bias and noise and needs more memory",
                      "",
                      Scale::logarithmic};
  Number<int> caustic_photons{
      "caustic-photons",
      "Caustic photons",
      100'000,
      {0, 100'000'000},
      "Photons emitted for the caustics map; only those scattered by specular or near-specular surfaces are stored",
      "",
      Scale::logarithmic};
  Number<int> nearest{"nearest",
                      "Photons per lookup",
                      50,
                      {2, 100'000},
                      "Number of nearest photons from which radiance is estimated. Raising it reduces noise, by the "
                      "square root, and increases blur",
                      "",
                      Scale::logarithmic};
  Number<float> beta{
      "beta",
      "Lookup count exponent",
      0,
      {0, 1},
      "Photons per lookup grow as (photons / 100,000)^\u03b2. Between 0 and 1 both bias and noise fall as photons are "
      "added, fastest at 2/3; at 0 noise stays, at 1 bias stays"};
  Number<float> radius{"radius",
                       "Max. radius",
                       0.1f,
                       {0, 1},
                       "Maximum lookup radius, as a fraction of the scene's diameter; 0: no limit",
                       "",
                       Scale::logarithmic};
  Choice<photon::Kernel> kernel{
      "kernel", "Kernel", photon::Kernel::constant,
      "Weight of photons by distance. Cone and Gaussian are sharper and noisier than constant"};
  Number<float> roughness{"roughness",
                          "Max. roughness traced as specular",
                          0.2f,
                          {0, 1},
                          "Glossy lobes below this roughness are ray traced; rougher ones use the photon map"};
  Number<int> gather{
      "gather", "Gather rays", 2, {1, 256}, "Rays per sample from the first rough surface; final gathering only"};
  Number<float> near{"near",
                     "Secondary gather distance",
                     0.02f,
                     {0, 1},
                     "At hits closer than this fraction of the scene's diameter, radiance comes from further gather "
                     "rays, not from the photon map. Raising it improves corners and is slower"};
  Toggle renew{"renew", "New photons per sample", false,
               "Averages the blotches of many maps; the bias of one map stays. Always on for scenes with motion"};
  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random. Lower is faster and noisier"};

  auto parameters() {
    return std::tie(max_depth, mode, photons, caustic_photons, nearest, beta, radius, kernel, roughness, gather, near,
                    renew, roulette_start);
  }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const final;

 private:
  transport::LobeSplit split() const { return transport::LobeSplit(roughness); }
  bool is_direct() const { return mode == PhotonUse::is_direct; }

  // The lookup parameters of a map of so many emitted photons.
  NearestPhotons nearest_of(int emitted, float size) const {
    constexpr double kReference = 100'000;
    const double count = nearest * std::pow(emitted / kReference, double{beta});
    const float max_distance = radius > 0 ? radius * size : kInfinity;
    return {static_cast<size_t>(std::clamp(count + 0.5, 2.0, 1e7)), sqr(max_distance), kernel};
  }

  // `scattering`: the scene has media that scatter.
  PhotonPlan plan(bool caustics, bool scattering) const {
    PhotonPlan plan;
    plan.photons = max_depth == 1 ? 0 : caustics ? caustic_photons : photons;
    plan.split = split();
    plan.caustics = caustics;
    plan.min_length = caustics ? 2 : 1;
    if (scattering && !caustics) plan.min_volume_length = is_direct() ? 1 : 2;
    plan.max_length = std::max(0, max_depth - 1);
    return plan;
  }

  class Maps;
};

// A global map and a caustics map for each half-buffer.
class PhotonMapping::Maps final : public RenderState {
 public:
  Maps(const PhotonMapping& integrator, const RenderContext& context, const Maps* previous)
      : integrator_(integrator), context_(context), size_(2 * context.scene->bounds().radius()) {
    if (context.model->classes) join_.emplace(*context.model->paths);
    const bool can_reuse = previous && !renews() && !previous->renews() && previous->same_light(context);
    for (uint32_t half = 0; half < film::kHalfBuffers; ++half)
      for (const bool caustics : {false, true}) {
        const bool has_caustics = !context.model->diffuse || context.scene->solids().any_medium_emits();
        if (caustics && (integrator.is_direct() || !has_caustics)) continue;
        auto& emission = emissions_[half][caustics];
        const PhotonPlan plan = integrator.plan(caustics, context.model->scattering);
        if (can_reuse) emission = previous->emissions_[half][caustics];
        if (!emission || !(emission->plan() == plan)) emission = std::make_shared<PhotonEmission>(plan, half);
      }
  }

  std::vector<Phase> phases(uint32_t sample) override {
    std::vector<Phase> phases;
    running_.clear();
    for (const auto& emission : emissions_[sample % film::kHalfBuffers]) {
      if (!emission) continue;
      if (renews()) emission->begin(emission->plan(), sample);
      if (emission->is_ready()) continue;
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
    return transport::with_scattering_model(*context_.model,
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
      if (emission && emission->is_ready()) add_points(*emission, kMostPoints / 2, *points);
    return points;
  }

 private:
  // Moving objects require photons of the same time.
  bool renews() const { return integrator_.renew || context_.model->moving; }

  bool same_light(const RenderContext& context) const {
    const transport::Model &a = *context_.model, &b = *context.model;
    return context.seed == context_.seed && a.diffuse == b.diffuse && a.wide == b.wide && a.media == b.media &&
           a.scattering == b.scattering && a.classes == b.classes &&
           (!a.classes || a.paths->automaton() == b.paths->automaton()) && context.scene->same_light(*context_.scene);
  }

  PhotonView view(uint32_t sample, bool caustics, const TaskContext& task_context) const {
    const auto& emission = emissions_[sample % film::kHalfBuffers][caustics];
    return {.map = emission ? &emission->map() : nullptr,
            .split = integrator_.split(),
            .join = join_ ? &*join_ : nullptr,
            .max_length = integrator_.max_depth,
            .watch = task_context.overhead_timer,
            .volume_map = emission ? emission->volume_map() : nullptr};
  }

  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) const {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    const PixelOrder order(block);
    launch_camera_paths(at_shared_time(context_, block.sample), block, order, task_context, paths);
    paths.stratify_channels();
    if (integrator_.is_direct()) {
      if (!estimate_direct(view(block.sample, false, task_context), task_context, paths)) return {};
      return collect(paths, order, radiance);
    }
    static thread_local const auto gatherer = std::make_unique<FinalGather<M>>();
    gatherer->begin(
        {view(block.sample, false, task_context), integrator_.nearest_of(integrator_.photons, size_)},
        {view(block.sample, true, task_context), integrator_.nearest_of(integrator_.caustic_photons, size_)},
        integrator_.gather, integrator_.near * size_);
    if (!estimate_by_terms(task_context, *gatherer, paths)) return {};
    const auto rays = collect(paths, order, radiance);
    if (!rays || gatherer->cancelled()) return {};
    return *rays + gatherer->rays_traced();
  }

  // False if the task was cancelled, which is polled because lookups are slow.
  template <class M>
  bool estimate_direct(const PhotonView& view, const TaskContext& task_context,
                       transport::PathWavefront<M>& paths) const {
    using namespace transport;
    ShallowCollisions<M> shallow(paths);
    DirectLightByLobe<M> direct_light(paths, view.split, shallow);
    EmissionOfMedia<M> media(paths);
    while (paths.trace()) {
      media.add_emission_of_misses();
      add_environment(paths, kLobeSplitHeuristic);
      while (paths.next_hits()) {
        if (!should_continue(task_context)) return false;
        media.add_emission_before_hits();
        add_emission(paths, kLobeSplitHeuristic);
        shallow.begin_hits();
        if (integrator_.at_max_depth(paths.length())) continue;
        const NearestPhotons nearest = integrator_.nearest_of(integrator_.photons, size_);
        add_nearest_volume_photons(paths, view, nearest, 0, shallow);
        direct_light.add_near_specular();
        add_nearest_photons(paths, view, nearest, 0);
        continue_near_specular(paths, view.split, shallow, integrator_.roulette_start);
      }
    }
    return true;
  }

  template <class M>
  bool estimate_by_terms(const TaskContext& task_context, FinalGather<M>& gatherer,
                         transport::PathWavefront<M>& paths) const {
    using namespace transport;
    const LobeSplit split = integrator_.split();
    ShallowCollisions<M> shallow(paths);
    DirectLightByLobe<M> direct_light(paths, split, shallow);
    EmissionOfMedia<M> media(paths);
    while (paths.trace()) {
      media.add_emission_of_misses();
      add_environment(paths, kLobeSplitHeuristic);
      if (!integrator_.at_max_depth(paths.length())) direct_light.add_on_misses();
      while (paths.next_hits()) {
        if (!should_continue(task_context)) return false;
        media.add_emission_before_hits();
        add_emission(paths, kLobeSplitHeuristic);
        shallow.begin_hits();
        if (integrator_.at_max_depth(paths.length())) continue;
        gatherer.add_volume_photons(paths, shallow);
        direct_light.add();
        gatherer.add_caustics(paths);
        gatherer.gather(context_, task_context, paths);
        continue_near_specular(paths, split, shallow, integrator_.roulette_start);
      }
    }
    return true;
  }

  const PhotonMapping& integrator_;
  const RenderContext context_;
  const float size_;  // diameter of the scene
  const RandomSampler random_;
  std::optional<transport::ClassJoin> join_;
  std::array<std::array<std::shared_ptr<PhotonEmission>, 2>, film::kHalfBuffers> emissions_;
  std::vector<PhotonEmission*> running_;  // each for two phases
};

std::unique_ptr<RenderState> PhotonMapping::begin(const RenderContext& context, const RenderState* previous) const {
  return std::make_unique<Maps>(*this, context, dynamic_cast<const Maps*>(previous));
}

Registration photon_mapping() { return registration<PhotonMapping>(); }

}  // namespace etendue::integrator
