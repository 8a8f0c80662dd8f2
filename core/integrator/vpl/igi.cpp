// Instant global illumination                                 [Lang, sec. 9.6, eq. 9.148-9.158, corrected; Keller 1997]
//
// The vertices y_j of a few light paths become virtual point lights with flux Phi_j (virtual_lights.h). A camera path
// follows mirrors and clear glass to its first other vertex z. There direct light is estimated as in path tracing, and
// every virtual light is connected:
//
//    L(z)  ~  direct light  +  sum over j  f_s(z) G(y_j, z) V f_s(y_j) Phi_j,      G = cos cos / r^2
//
// G, and with it the variance, is unbounded for close y and z. If G is clamped to a bound, the missing part can be
// estimated by BSDF sampling from z [Kollig and Keller 2004]: the next vertex is treated like z and weighted by the
// clamped fraction,
//
//    1 = min(1, bound / G)  +  max(0, 1 - bound / G)
//             lights              BSDF sampling
//
// In scattering media, vertices at collisions become virtual lights and are lit by them, with the phase function in
// place of the BSDF and a cosine of 1. The transmittance of a connection is not part of G. Light paths also start in
// media that emit. z receives direct light of these media by direction samples, as in path tracing (MediumLight).
//
// With interleaving, the virtual lights are divided among the pixels of small squares [Keller and Heidrich 2001].
// Pixels that share virtual lights have correlated errors: a wrong brightness instead of noise.
//
// As a hybrid with photon mapping [Lang, sec. 9.6], a caustics map adds the light that reaches z, or the next vertex of
// the compensation, through mirrors and glass only: ES*(D|G)S+L. No virtual light is connected along these paths.
//
//   Paths         ES*[(D|G|V)[(D|G|V).*]]L; point lights: ES*(D|G|V)[(D|G|V).*]L;
//                 with a caustics map ES*(D|G)S+L too
//   Bias          biased by default. None with the full BSDF of virtual lights, or if all surfaces are diffuse, and
//                 with no bound, or with compensation
//   Cost          per sample 3 rays and one per virtual light; each light path makes 2 to 4 of a few hundred bytes
//   Limitations   Caustics, and light that reaches visible surfaces through glass, are missing without a caustics map.
//                 Corners show splotches, or with a bound and without compensation are too dark. Compensation misses
//                 light that reaches the next vertex through glass, so media inside glass need a contribution bound
//                 of 0. Glossy virtual lights are treated as diffuse unless the full BSDF is used.
#include "integrator/integrator_base.h"
#include "integrator/photon/photon_emission.h"
#include "integrator/photon/photon_lookup.h"
#include "integrator/registration.h"
#include "integrator/vpl/virtual_lighting.h"
#include "integrator/vpl/virtual_lights.h"
#include "sampling/random.h"
#include "transport/wavefront/medium_light.h"

namespace etendue::integrator {

class InstantGlobalIllumination final : public IntegratorBase<InstantGlobalIllumination> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "igi",
        .label = "Instant global illumination",
        .summary =
            "Virtual point lights at the vertices of a few light paths, connected to the visible surfaces of all "
            "pixels",
        .group = Group::two_pass,
        .paths = "ES*[(D|G|V)[(D|G|V).*]]L",
        .point_paths = "ES*(D|G|V)[(D|G|V).*]L",
        .bias = Bias::biased,
        .cost = "per sample 3 rays and 1 per virtual light; each light path makes 2 to 4 of a few hundred bytes",
        .limitations =
            "Caustics, and light that reaches visible surfaces through glass, are missing without a caustics map. "
            "Corners show splotches, or with a bound and without compensation are too dark. Compensation misses light "
            "that reaches the next vertex through glass, so media inside glass need a contribution bound of 0. Glossy "
            "virtual lights are treated as diffuse unless the full BSDF is used.",
        .accumulation = Accumulation::per_image,
        .division = {DivisionUnit::passes, true,
                     "The virtual lights of a sample depend on its number only. Each region makes them again."},
        .scattering_media = true,
        .heterogeneous_media = true,
        .emitting_media = true,
        .starts_in_media = true,
    };
  }

  Number<int> light_paths{
      "light-paths",
      "Light paths",
      32,
      {1, 100'000},
      "Each makes a few virtual lights that all pixels are connected to. Raising it reduces the error and is slower",
      "",
      Scale::logarithmic};
  Number<int> interleave{
      "interleave",
      "Interleaved pixels",
      1,
      {1, 16},
      "Side length of pixel squares among which the virtual lights are divided. Raising it is faster; the error "
      "becomes a pattern"};
  Toggle full{"full-bsdf", "Full BSDF of virtual lights", false,
              "Virtual lights scatter by the BSDF of their surface. Off: diffusely"};
  Number<float> bound{"bound",
                      "Clamp geometry term",
                      0,
                      {0, 1e9f},
                      "Maximum of cos\u03b8 cos\u03b8\u2032 / r\u00b2 of a connection; 0: no clamping. Lower values "
                      "remove splotches and "
                      "darken corners",
                      "1/m\u00b2",
                      Scale::logarithmic};
  Toggle compensate{"compensate", "Bias compensation", true,
                    "Estimates the clamped light by BSDF sampling: removes the bias, adds noise"};
  Toggle renew{"renew", "New lights per sample", true,
               "Off: the error of the first lights remains, unless the scene moves"};
  Number<int> caustic_photons{"caustic-photons",
                              "Caustic photons",
                              0,
                              {0, 100'000'000},
                              "Photons of a map of caustics, which virtual lights miss; 0: none. Raising it sharpens "
                              "caustics and needs memory. "
                              "Without effect if media emit light",
                              "",
                              Scale::logarithmic};
  Number<int> roulette_start{
      "roulette-start",
      "Russian roulette start depth",
      4,
      {1, 64},
      "Length of camera paths from which they are terminated at random. Lower is faster and noisier"};

  using IntegratorBase::at_max_depth;

  auto parameters() {
    return std::tie(max_depth, light_paths, interleave, full, bound, compensate, renew, caustic_photons,
                    roulette_start);
  }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const final;

  SampledPaths sampled_paths(const scene::CompiledScene* scene) const final {
    if (caustic_photons == 0 || (scene && !may_have_caustics(*scene))) return IntegratorBase::sampled_paths(scene);
    return {"ES*[(D|G|V)[(D|G|V).*]|(D|G)S+]L", "ES*((D|G|V)[(D|G|V).*]|(D|G)S+)L"};
  }

  // Photons that start in media would find the direct light of these media a second time.
  static bool may_have_caustics(const scene::CompiledScene& scene) { return !scene.solids().any_medium_emits(); }

  VirtualLightPlan plan() const {
    VirtualLightPlan plan;
    plan.subsets = interleave * interleave;
    plan.paths = (light_paths + plan.subsets - 1) / plan.subsets * plan.subsets;
    plan.lambertian = !full;
    plan.max_length = max_depth > 0 ? std::max(1, max_depth - 2) : 0;
    return plan;
  }

  // The photons of the caustics map.
  PhotonPlan caustics_plan() const {
    PhotonPlan plan;
    plan.photons = caustic_photons;
    plan.caustics = true;
    plan.min_length = 2;
    plan.max_length = std::max(0, max_depth - 1);
    return plan;
  }
};
namespace {

// Combines light sampling and BSDF sampling of direct light.
constexpr auto kHeuristic = transport::MisHeuristic::power;

// Photons of an estimate from the caustics map, and the largest radius relative to the diameter of the scene.
constexpr size_t kCausticNeighbours = 100;
constexpr float kCausticRadius = 0.05f;

// The virtual lights of one sample, or of a half-buffer.
struct LightSet {
  uint32_t sample = 0;                             // of the random numbers
  std::vector<std::vector<VirtualLight>> by_task;
  std::vector<VirtualLight> all;
  bool is_ready = false;
  std::unique_ptr<PhotonEmission> caustics;  // null: no map
};

class IgiState final : public RenderState {
 public:
  IgiState(const InstantGlobalIllumination& integrator, const RenderContext& context)
      : integrator_(integrator), context_(context), plan_(integrator.plan()) {
    if (context.model->classes) join_.emplace(*context.model->paths);
    const bool has_caustics = integrator.caustic_photons > 0 && integrator.max_depth != 1 && !context.model->diffuse &&
                              integrator.may_have_caustics(*context.scene);
    for (uint32_t half = 0; half < film::kHalfBuffers; ++half) {
      lights_[half].sample = half;
      if (has_caustics) lights_[half].caustics = std::make_unique<PhotonEmission>(integrator.caustics_plan(), half);
    }
  }

  std::vector<Phase> phases(uint32_t sample) override {
    LightSet& lights = lights_for(sample);
    if (renews_lights()) {
      lights.sample = sample;
      lights.is_ready = false;
    }
    if (lights.caustics && renews_lights()) lights.caustics->begin(lights.caustics->plan(), sample);
    std::vector<Phase> phases;
    makes_lights_ = !lights.is_ready && has_indirect();
    if (makes_lights_) {
      lights.by_task.resize(static_cast<size_t>(plan_.tasks()));
      phases.push_back({"making virtual lights", plan_.tasks()});
    }
    if (lights.caustics && !lights.caustics->is_ready()) lights.caustics->add_phases(phases);
    return phases;
  }

  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const TaskContext& task_context) override {
    LightSet& lights = lights_for(sample);
    RenderContext context = at_shared_time(context_, sample);
    if (!renews_lights()) context.sampler = &random_;
    if (!is_phase_of_lights(phase)) return lights.caustics->run(context, photon_step(phase), task, task_context);
    return transport::with_scattering_model(*context_.model, [&]<class M>(M) {
      return make_virtual_lights<M>(context, lights.sample, plan_, task, task_context,
                                    lights.by_task[static_cast<size_t>(task)]);
    });
  }

  void finish(uint32_t sample, size_t phase) override {
    LightSet& lights = lights_for(sample);
    if (!is_phase_of_lights(phase)) return lights.caustics->finish(photon_step(phase));
    lights.all.clear();
    for (const auto& list : lights.by_task) lights.all.insert(lights.all.end(), list.begin(), list.end());
    lights.is_ready = true;
  }

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_scattering_model(*context_.model,
                                            [&]<class M>(M) { return sample_with<M>(block, radiance, task_context); });
  }

  size_t memory() const override {
    size_t count = 0;
    for (const LightSet& lights : lights_) {
      count += lights.all.capacity();
      for (const auto& list : lights.by_task) count += list.capacity();
    }
    size_t photons = 0;
    for (const LightSet& lights : lights_) photons += lights.caustics ? lights.caustics->memory() : 0;
    return count * sizeof(VirtualLight) + photons;
  }

  std::shared_ptr<const std::vector<StoredPoint>> points() const override {
    auto points = std::make_shared<std::vector<StoredPoint>>();
    for (const VirtualLight& light : lights_[0].all)
      if (points->size() < kMostPoints) points->push_back({light.point.position, light.power});
    return points;
  }

 private:
  // Moving objects require virtual lights of the same time.
  bool renews_lights() const { return integrator_.renew || context_.model->moving; }

  // The phases of a sample: virtual lights, unless they are ready, then the steps of the photons.
  bool is_phase_of_lights(size_t phase) const { return makes_lights_ && phase == 0; }
  PhotonEmission::Step photon_step(size_t phase) const {
    return static_cast<PhotonEmission::Step>(phase - (makes_lights_ ? 1 : 0));
  }

  LightSet& lights_for(uint32_t sample) { return lights_[sample % film::kHalfBuffers]; }
  // The shortest path with a virtual light has three edges.
  bool has_indirect() const { return integrator_.max_depth == 0 || integrator_.max_depth > 2; }

  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) const {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    const PixelOrder order(block);
    launch_camera_paths(at_shared_time(context_, block.sample), block, order, task_context, paths);
    paths.stratify_channels();
    static thread_local const auto lighting = std::make_unique<VirtualLighting<M>>();
    const int interleave_width = integrator_.interleave;
    lighting->begin({lights_[block.sample % film::kHalfBuffers].all, plan_.lambertian, integrator_.bound,
                     integrator_.max_depth, join_ ? &*join_ : nullptr},
                    order.size(), [&](int i) {
                      return static_cast<uint32_t>((block.y + order.y(i)) % interleave_width * interleave_width +
                                                   (block.x + order.x(i)) % interleave_width);
                    });
    if (!estimate(task_context, block.sample, *lighting, paths)) return {};
    const auto rays = collect(paths, order, radiance);
    if (!rays) return {};
    return *rays + lighting->rays_traced();
  }

  // False if the task was cancelled, which is polled because connections are slow.
  template <class M>
  bool estimate(const TaskContext& task_context, uint32_t sample, VirtualLighting<M>& lighting,
                transport::PathWavefront<M>& paths) const {
    using namespace transport;
    const PhotonEmission* caustics = lights_[sample % film::kHalfBuffers].caustics.get();
    const PhotonView view{.map = caustics ? &caustics->map() : nullptr,
                          .join = join_ ? &*join_ : nullptr,
                          .max_length = integrator_.max_depth,
                          .watch = task_context.overhead_timer};
    const NearestPhotons nearest{kCausticNeighbours, sqr(2 * kCausticRadius * context_.scene->bounds().radius()),
                                 photon::Kernel::cone};
    static thread_local std::array<float, PathWavefront<M>::kCapacity> departure_cosines;  // of the sampled directions
    MediumLight<M> media(paths, kHeuristic);
    while (paths.trace()) {
      media.add_emission_of_misses();
      add_environment(paths, kHeuristic);
      while (paths.next_hits()) {
        if (!should_continue(task_context)) return false;
        media.add_emission_before_hits();
        add_emission(paths, kHeuristic);
        if (integrator_.at_max_depth(paths.length())) continue;
        apply_bound_compensation(paths, departure_cosines);
        add_direct_light(paths, LightStrategy::automatic, kHeuristic);
        media.add_light_samples();
        if (caustics) add_nearest_photons(paths, view, nearest, 0);
        lighting.add(paths);
        sample_bsdf_and_record(
            paths, integrator_.roulette_start, TransportMode::radiance,
            [&](int i, const auto& s) {
              departure_cosines[static_cast<size_t>(paths.path_at(i))] = geometric_cosine(paths, i, s.wi);
            },
            [](PathWavefront<M>& subpaths, int i, auto& s) { return accept_direction(subpaths, i, s); });
      }
    }
    return true;
  }

  // Accepts specular samples while the path is purely specular. From the first other vertex on, one step that may hit a
  // light, and further steps where the bound is compensated; but no specular ones, because virtual lights are not
  // connected through mirrors.
  template <class M>
  static bool accept_direction(transport::PathWavefront<M>& paths, int i, LobeSample<typename M::Color>& s) {
    const auto& path = paths.state_at(i);
    return (path.all_specular || !s.delta) && !is_black(path.throughput) && transport::AcceptAll()(paths, i, s);
  }

  // Weights throughputs by the fraction of the connection that was clamped at the previous vertex.
  template <class M>
  void apply_bound_compensation(transport::PathWavefront<M>& paths, std::span<const float> departure_cosines) const {
    const bool follows_bound = integrator_.bound > 0 && integrator_.compensate;
    for (int i = 0; i < paths.hit_count(); ++i) {
      auto& path = paths.state_at(i);
      if (path.all_specular) continue;
      const Vec3 d = paths.point(i).position - path.from;
      const float departure_cosine = departure_cosines[static_cast<size_t>(paths.path_at(i))];
      const float geometry = geometry_term(departure_cosine, glm::dot(paths.point(i).ng, paths.wo(i)), glm::dot(d, d));
      path.throughput *= follows_bound ? 1 - bounded_fraction(geometry, integrator_.bound) : 0;
    }
  }

  const InstantGlobalIllumination& integrator_;
  const RenderContext context_;
  const VirtualLightPlan plan_;
  const RandomSampler random_;
  std::optional<transport::ClassJoin> join_;
  std::array<LightSet, film::kHalfBuffers> lights_;
  bool makes_lights_ = false;  // in the current sample
};

}  // namespace

std::unique_ptr<RenderState> InstantGlobalIllumination::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<IgiState>(*this, context);
}

Registration instant_global_illumination() { return registration<InstantGlobalIllumination>(); }

}  // namespace etendue::integrator
