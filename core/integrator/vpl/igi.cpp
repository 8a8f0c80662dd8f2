// Instant global illumination: a few light paths for all pixels.       thesis 9.6, (9.148)-(9.158), E33; S40, S41
//                                              Keller 1997; interleaved: Keller & Heidrich 2001; bounded: Kollig &
//                                              Keller 2004
// The camera's walk follows mirrors and clear glass to the first other vertex z, where direct light is found as in path
// tracing and every virtual light (virtual_lights.h) is connected. Vertices y and z that come close make G = cos cos /
// r^2, and with it the variance, infinite. Where G is kept below a bound, what is lost is found again, if wanted, by a
// walk from z by the BSDF: at the vertex where it arrives everything is done as at z, weighed by what the bound cut
// off,
//
//   1 = min(1, bound / G)  +  max(0, 1 - bound / G)
//                    lights   walk
//
// Unbiased with the full BSDF of virtual lights, or where all surfaces are diffuse; and with no bound, or with what it
// loses found again. Pixels that share virtual lights share their error: it shows as a wrong brightness, not as noise.
#include "integrator/integrator_base.h"
#include "integrator/registration.h"
#include "integrator/vpl/virtual_lighting.h"
#include "integrator/vpl/virtual_lights.h"
#include "sampling/random.h"

namespace etendue::integrator {

class InstantGlobalIllumination final : public IntegratorBase<InstantGlobalIllumination> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "igi",
        .label = "Instant global illumination",
        .summary = "Virtual point lights on a few light paths, connected to what all pixels see",
        .group = Group::two_pass,
        .paths = "ES*[(D|G)[(D|G).*]]L",
        .point_paths = "ES*(D|G)[(D|G).*]L",
        .bias = Bias::biased,
        .cost =
            "3 + the number of virtual lights rays per sample: 2 to 4 for each light path; a few hundred bytes for "
            "each",
        .limitations =
            "caustics and whatever shines through glass onto what is seen: black; corners: splotches, or with a bound "
            "and without compensation too dark; glossy surfaces as virtual lights are taken for matt ones unless told "
            "otherwise",
        .accumulation = Accumulation::per_image,
    };
  }

  Number<int> light_paths{"light-paths",
                          "Light paths",
                          32,
                          {1, 100'000},
                          "Each leaves a few virtual lights, which every pixel is connected to",
                          "",
                          Scale::logarithmic};
  Number<int> interleave{
      "interleave",
      "Interleaved pixels",
      1,
      {1, 16},
      "The lights are dealt out to squares of so many pixels a side: faster, and the error becomes a "
      "pattern"};
  Toggle full{"full-bsdf", "Full BSDF of virtual lights", false,
              "Virtual lights scatter as their surface does; else as if it were matt"};
  Number<float> bound{"bound",
                      "Bound of G",
                      0,
                      {0, 1e9f},
                      "The largest cos cos / r^2 of a connection; 0: none. Lower: darker corners without splotches",
                      "1/m^2",
                      Scale::logarithmic};
  Toggle compensate{"compensate", "Find what the bound loses", true,
                    "By walks from the camera's vertices: no bias, noise"};
  Toggle renew{"renew", "New lights for every sample", true,
               "Else the error of the first lights stays, unless something moves"};
  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Of the camera's walk. Earlier: faster, noisier"};

  using IntegratorBase::at_max_depth;

  auto parameters() {
    return std::tie(max_depth, light_paths, interleave, full, bound, compensate, renew, roulette_start);
  }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const final;

  VirtualLightPlan plan() const {
    VirtualLightPlan plan;
    plan.subsets = interleave * interleave;
    plan.paths = (light_paths + plan.subsets - 1) / plan.subsets * plan.subsets;
    plan.lambertian = !full;
    plan.longest = max_depth > 0 ? std::max(1, max_depth - 2) : 0;
    return plan;
  }
};
namespace {

// By which light samples and the walk's own direction share direct light.
constexpr auto kHeuristic = transport::MisHeuristic::power;

// The virtual lights of one sample, or of a half of the film, in the making.
struct Lights {
  uint32_t sample = 0;                           // whose random numbers they are made with
  std::vector<std::vector<VirtualLight>> found;  // by task
  std::vector<VirtualLight> all;
  bool ready = false;
};

class VirtualLights final : public RenderState {
 public:
  VirtualLights(const InstantGlobalIllumination& method, const RenderContext& context)
      : method_(method), context_(context), plan_(method.plan()) {
    if (context.model->classes) join_.emplace(*context.model->paths);
    for (uint32_t half = 0; half < film::kHalfBuffers; ++half) lights_[half].sample = half;
  }

  std::vector<Phase> phases(uint32_t sample) override {
    Lights& lights = lights_of(sample);
    if (renews()) lights.sample = sample, lights.ready = false;
    if (lights.ready || !indirect()) return {};
    lights.found.resize(static_cast<size_t>(plan_.tasks()));
    return {{"making virtual lights", plan_.tasks()}};
  }

  std::optional<uint64_t> run(uint32_t sample, size_t, int task, const TaskContext& task_context) override {
    Lights& lights = lights_of(sample);
    RenderContext context = at_shared_time(context_, sample);
    if (!renews()) context.sampler = &random_;
    return transport::with_model(*context_.model, [&]<class M>(M) {
      return make_virtual_lights<M>(context, lights.sample, plan_, task, task_context,
                                    lights.found[static_cast<size_t>(task)]);
    });
  }

  void finish(uint32_t sample, size_t) override {
    Lights& lights = lights_of(sample);
    lights.all.clear();
    for (const auto& list : lights.found) lights.all.insert(lights.all.end(), list.begin(), list.end());
    lights.ready = true;
  }

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_model(*context_.model,
                                 [&]<class M>(M) { return sample_with<M>(block, radiance, task_context); });
  }

  size_t memory() const override {
    size_t count = 0;
    for (const Lights& lights : lights_) {
      count += lights.all.capacity();
      for (const auto& list : lights.found) count += list.capacity();
    }
    return count * sizeof(VirtualLight);
  }

  std::shared_ptr<const std::vector<StoredPoint>> points() const override {
    auto points = std::make_shared<std::vector<StoredPoint>>();
    for (const VirtualLight& light : lights_[0].all)
      if (points->size() < kMostPoints) points->push_back({light.point.position, light.power});
    return points;
  }

 private:
  // What moves needs lights of its own time.
  bool renews() const { return method_.renew || context_.model->moving; }

  Lights& lights_of(uint32_t sample) { return lights_[sample % film::kHalfBuffers]; }
  // Virtual lights are the second vertex at the earliest.
  bool indirect() const { return method_.max_depth == 0 || method_.max_depth > 2; }

  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) const {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    const PixelOrder order(block);
    launch_camera_paths(at_shared_time(context_, block.sample), block, order, task_context, paths);
    static thread_local const auto lighting = std::make_unique<VirtualLighting<M>>();
    const int side = method_.interleave;
    lighting->begin(
        {lights_[block.sample % film::kHalfBuffers].all, plan_.lambertian, method_.bound, method_.max_depth,
         join_ ? &*join_ : nullptr},
        order.size(), [&](int i) {
          return static_cast<uint32_t>((block.y + order.y(i)) % side * side + (block.x + order.x(i)) % side);
        });
    if (!estimate(task_context, *lighting, paths)) return {};
    const auto rays = collect(paths, order, radiance);
    if (!rays) return {};
    return *rays + lighting->rays_traced();
  }

  // False if nobody wants it any more: a few vertices take a while.
  template <class M>
  bool estimate(const TaskContext& task_context, VirtualLighting<M>& lighting,
                transport::PathWavefront<M>& paths) const {
    using namespace transport;
    static thread_local std::array<float, PathWavefront<M>::kCapacity> departures;  // cosines by which paths left
    while (paths.trace()) {
      add_environment(paths, kHeuristic);
      while (paths.next_hits()) {
        if (!should_continue(task_context)) return false;
        add_emission(paths, kHeuristic);
        if (method_.at_max_depth(paths.length())) continue;
        weigh_by_loss(paths, departures);
        add_direct_light(paths, LightStrategy::automatic, kHeuristic);
        lighting.add(paths);
        sample_bsdf_and_record(
            paths, method_.roulette_start, TransportMode::radiance,
            [&](int i, const auto& s) {
              departures[static_cast<size_t>(paths.path_at(i))] = glm::dot(paths.point(i).ng, s.wi);
            },
            [](PathWavefront<M>& walks, int i, auto& s) { return goes_on(walks, i, s); });
      }
    }
    return true;
  }

  // Mirrors from the camera on; from the first other vertex one step that may meet a light, and more where a bound
  // loses something, but not by mirrors: virtual lights are not connected through them.
  template <class M>
  static bool goes_on(transport::PathWavefront<M>& paths, int i, LobeSample<typename M::Color>& s) {
    const auto& path = paths.state_at(i);
    return (path.all_specular || !s.delta) && !is_black(path.throughput) && transport::TakeAll()(paths, i, s);
  }

  // What virtual lights have done for the vertex before is not done again.
  template <class M>
  void weigh_by_loss(transport::PathWavefront<M>& paths, std::span<const float> departures) const {
    const bool follows_bound = method_.bound > 0 && method_.compensate;
    for (int i = 0; i < paths.hit_count(); ++i) {
      auto& path = paths.state_at(i);
      if (path.all_specular) continue;
      const Vec3 d = paths.point(i).position - path.from;
      const float left = departures[static_cast<size_t>(paths.path_at(i))];
      const float geometry = geometry_term(left, glm::dot(paths.point(i).ng, paths.wo(i)), glm::dot(d, d));
      path.throughput *= follows_bound ? 1 - kept_of(geometry, method_.bound) : 0;
    }
  }

  const InstantGlobalIllumination& method_;
  const RenderContext context_;
  const VirtualLightPlan plan_;
  const RandomSampler random_;
  std::optional<transport::ClassJoin> join_;
  std::array<Lights, film::kHalfBuffers> lights_;
};

}  // namespace

std::unique_ptr<RenderState> InstantGlobalIllumination::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<VirtualLights>(*this, context);
}

Registration instant_global_illumination() { return registration<InstantGlobalIllumination>(); }

}  // namespace etendue::integrator
