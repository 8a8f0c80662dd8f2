// Progressive photon mapping: photons that are forgotten after each sample.   digest 8-10: S35, Remark 9.33
//                                             Hachisuka & Jensen 2009; in the form of Knaus & Zwicker 2011
// Each sample of the picture sends out photons of its own and estimates the light on the first wide surface that the
// camera's walk comes to, from all photons within a radius that shrinks from sample to sample:
//
//   r_i+1^2 / r_i^2 = (i + alpha) / (i + 1)
//
// The variance of a sample grows as 1 / r^2, slowly enough that the mean over samples still converges (as n^-alpha);
// its bias falls as r^2, that is as n^(alpha - 1). Hachisuka and Jensen keep a radius and photon statistics for each
// pixel and let them shrink by what was found there; here the radius follows from the sample's number alone, so that
// samples are independent and a film of means holds them. Each half of the film counts its own samples. The first
// radius follows the pixel's footprint: about so many pixels, seen over the length of the walk.
#include "integrator/integrator_base.h"
#include "integrator/photon/photon_emission.h"
#include "integrator/photon/photon_lookup.h"
#include "integrator/photon/photon_paths.h"
#include "integrator/registration.h"

namespace etendue::integrator {

class ProgressivePhotonMapping final : public IntegratorBase<ProgressivePhotonMapping> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "sppm",
        .label = "Progressive photon mapping",
        .summary = "New photons for every sample, looked up within a radius that shrinks",
        .group = Group::two_pass,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G).*L",
        .bias = Bias::consistent,
        .cost =
            "2 to 4 rays per photon and about 2 per pixel for each sample, a lookup for each pixel; 32 bytes for each "
            "photon that one sample stores, twice",
        .limitations =
            "early samples blur, and light leaks through what is thinner than the radius; error falls as samples^-1/3 "
            "at "
            "best: slower than unbiased methods where these find the light; views of a small part of what is lit: few "
            "photons come by",
        .accumulation = Accumulation::per_image,
        .shortcut = '9',
    };
  }

  Number<int> photons{"photons", "Photons for a sample", 0, {0, 100'000'000}, "0: as many as pixels",
                      "",        Scale::logarithmic};
  Number<float> alpha{"alpha",
                      "Rate of shrinking",
                      2.0f / 3,
                      {0.01f, 1},
                      "Larger: the radius shrinks more slowly, noise falls faster, bias more slowly; 1: it stays"};
  Number<float> radius{"radius", "First radius",    4, {0.1f, 1000}, "As it is seen where the camera looks",
                       "px",     Scale::logarithmic};
  Toggle connect{"connect", "Direct light by shadow rays", true, "Else from photons too"};
  Number<float> roughness{"roughness",
                          "Narrow below roughness",
                          0.2f,
                          {0, 1},
                          "Glossy lobes below are followed by rays as mirrors are, others are estimated from photons"};
  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Of the camera's walk. Earlier: faster, noisier"};

  using IntegratorBase::at_max_depth;

  auto parameters() { return std::tie(max_depth, photons, alpha, radius, connect, roughness, roulette_start); }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const final;

  PhotonPlan plan(int pixels) const {
    PhotonPlan plan;
    plan.photons = max_depth == 1 ? 0 : photons > 0 ? photons : pixels;
    plan.split = transport::LobeSplit(roughness);
    plan.shortest = connect ? 2 : 1;
    plan.longest = std::max(0, max_depth - 1);
    return plan;
  }

  // The squared radius of a half's sample number `index` (from 0) over the first one.
  double shrinking(uint32_t index) const {
    double ratio = 1;
    for (uint32_t i = 1; i <= index; ++i) ratio *= (i + double{alpha}) / (i + 1.0);
    return ratio;
  }
};
namespace {

// How wide a pixel is where it is seen: in the middle of the picture, over one metre of a walk and besides.
struct Footprint {
  float angle = 0, width = 0;

  Footprint(const CameraRays& camera, int width_of_picture, int height) {
    const Vec2 middle(0.5f * static_cast<float>(width_of_picture), 0.5f * static_cast<float>(height)), lens(0.5f);
    const Ray a = camera.ray(middle, lens), b = camera.ray(middle + Vec2(1, 0), lens);
    angle = glm::length(glm::cross(a.direction, b.direction));
    width = glm::distance(a.origin, b.origin);
  }
  float over(float length) const { return width + angle * length; }
};

class Progress final : public RenderState {
 public:
  Progress(const ProgressivePhotonMapping& method, const RenderContext& context)
      : method_(method),
        context_(context),
        footprint_(*context.camera, context.width, context.height),
        emission_(method.plan(context.width * context.height), 0) {
    if (context.model->classes) join_.emplace(*context.model->paths);
  }

  std::vector<Phase> phases(uint32_t sample) override {
    emission_.begin(emission_.plan(), sample);
    radius_ = method_.radius * static_cast<float>(std::sqrt(method_.shrinking(sample / film::kHalfBuffers)));
    std::vector<Phase> phases;
    emission_.add_phases(phases);
    return phases;
  }
  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const TaskContext& task_context) override {
    return emission_.run(at_shared_time(context_, sample), static_cast<PhotonEmission::Step>(phase), task,
                         task_context);
  }
  void finish(uint32_t, size_t phase) override { emission_.finish(static_cast<PhotonEmission::Step>(phase)); }

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_model(*context_.model,
                                 [&]<class M>(M) { return sample_with<M>(block, radiance, task_context); });
  }

  size_t memory() const override { return emission_.memory(); }

  std::shared_ptr<const std::vector<StoredPoint>> points() const override {
    auto points = std::make_shared<std::vector<StoredPoint>>();
    if (emission_.ready()) add_points(emission_.map(), kMostPoints, *points);
    return points;
  }

 private:
  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) const {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    const PixelOrder order(block);
    launch_camera_paths(at_shared_time(context_, block.sample), block, order, task_context, paths);
    estimate(paths, task_context.overhead_timer);
    return collect(paths, order, radiance);
  }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths, Stopwatch* watch) const {
    using namespace transport;
    const PhotonView view{&emission_.map(), emission_.plan().split, join_ ? &*join_ : nullptr, method_.max_depth,
                          watch};
    static thread_local std::array<float, PathWavefront<M>::kCapacity> walked;  // metres, of each path
    walked.fill(0);
    const auto radius2 = [&](int i) {
      return sqr(radius_ * footprint_.over(walked[static_cast<size_t>(paths.path_at(i))]));
    };
    while (paths.trace()) {
      add_environment(paths, kPartsHeuristic);
      while (paths.next_hits()) {
        add_emission(paths, kPartsHeuristic);
        if (method_.at_max_depth(paths.length())) continue;
        for (int i = 0; i < paths.hit_count(); ++i)
          walked[static_cast<size_t>(paths.path_at(i))] +=
              glm::distance(paths.state_at(i).from, paths.point(i).position);
        add_light_by_parts(paths, view.split, method_.connect ? LitParts::both : LitParts::near_specular);
        add_photons_within(paths, view, radius2);
        sample_bsdf(paths, method_.roulette_start, TransportMode::radiance, TakeNearSpecular{view.split});
      }
    }
  }

  const ProgressivePhotonMapping& method_;
  const RenderContext context_;
  const Footprint footprint_;
  PhotonEmission emission_;
  float radius_ = 0;  // pixels
  std::optional<transport::ClassJoin> join_;
};

}  // namespace

std::unique_ptr<RenderState> ProgressivePhotonMapping::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<Progress>(*this, context);
}

Registration progressive_photon_mapping() { return registration<ProgressivePhotonMapping>(); }

}  // namespace etendue::integrator
