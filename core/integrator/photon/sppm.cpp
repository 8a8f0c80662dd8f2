// Progressive photon mapping          [Lang, Remark 9.33, eq. 9.138; Hachisuka and Jensen 2009; Knaus and Zwicker 2011]
//
// Each sample traces its own photons and estimates the radiance at the first rough surface of each camera path from all
// photons within a radius that shrinks from sample to sample:
//
//    L_o  ~  1 / (pi r_i^2)  sum of f_s(w_photon, w_o) Phi,       r_i+1^2 / r_i^2 = (i + alpha) / (i + 1)
//
// The variance of a sample grows as 1 / r^2, slowly enough that the mean over samples converges (as n^-alpha); its bias
// falls as r^2, that is as n^(alpha - 1). [Hachisuka and Jensen 2009] store a radius and photon statistics per pixel;
// here the radius depends on the sample number alone [Knaus and Zwicker 2011], so that samples are independent and
// their mean is the image. Each half-buffer counts its own samples. The initial radius is a number of pixel footprints
// at the length of the path. In media it is the same everywhere: with footprints, which vanish at the camera,
// collisions close to a camera in a medium would have infinite variance.
//
// In scattering media, collisions are vertices like those of rough surfaces. Photons are stored at their collisions
// (photon_paths.h), and in-scattered radiance at the first collision of a camera path is estimated from those in a ball
// of radius r_i:
//
//    L_s  ~  1 / (4/3 pi r_i^3)  sum of p(w_photon, w_o) Phi / sigma_s,       r_i+1^3 / r_i^3 = (i + alpha) / (i + 1)
//
// The variance of a sample grows as 1 / r^3, and its bias falls as r^2 [Knaus and Zwicker 2011, sec. 4.2]. Direct light
// in media is treated as on surfaces: by shadow rays, or by photons (`connect`). Where the ball would reach beyond the
// boundary at which a camera path has entered the medium, the path continues instead (shallow_collisions.h).
//
// Media that emit are seen directly on the segments of camera paths. All other light of them comes from photons that
// start in media.
//
//   Paths         E(D|G|S|V)*L; point lights: E.*(D|G|V).*L
//   Bias          consistent
//   Cost          per sample 2 to 4 rays per photon, about 2 rays and one lookup per pixel; 34 bytes per stored photon,
//                 80 while they are sorted
//   Limitations   Early samples are blurred, and light leaks through objects thinner than the radius. The error falls
//                 as samples^-1/3 at best: slower than unbiased integrators where these find the light. Views of a
//                 small part of the lit scene receive few photons.
#include "integrator/integrator_base.h"
#include "integrator/photon/direct_light_by_lobe.h"
#include "integrator/photon/emission_of_media.h"
#include "integrator/photon/photon_emission.h"
#include "integrator/photon/photon_lookup.h"
#include "integrator/photon/photon_paths.h"
#include "integrator/photon/progressive_radius.h"
#include "integrator/registration.h"

namespace etendue::integrator {

class ProgressivePhotonMapping final : public IntegratorBase<ProgressivePhotonMapping> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "sppm",
        .label = "Progressive photon mapping",
        .summary = "New photons for every sample, looked up within a shrinking radius",
        .group = Group::two_pass,
        .paths = "E(D|G|S|V)*L",
        .point_paths = "E.*(D|G|V).*L",
        .bias = Bias::consistent,
        .cost =
            "per sample 2 to 4 rays per photon, about 2 rays and one lookup per pixel; 34 bytes per stored photon of a "
            "sample, 80 while they are sorted",
        .limitations =
            "Early samples are blurred, and light leaks through objects thinner than the radius. The error falls as "
            "samples^-1/3 at best: slower than unbiased integrators where these find the light. Views of a small part "
            "of the lit scene receive few photons.",
        .accumulation = Accumulation::per_image,
        .division =
            {DivisionUnit::passes, true,
             "The photons and the radius of a sample depend on its number only. Each region traces the photons again."},
        .shortcut = '9',
        .scattering_media = true,
        .heterogeneous_media = true,
        .emitting_media = true,
        .starts_in_media = true,
    };
  }

  Number<int> photons{
      "photons", "Photons per pass", 0, {0, 100'000'000}, "Photons emitted per sample; 0: as many as pixels",
      "",        Scale::logarithmic};
  Number<float> alpha{
      "alpha",
      "Alpha (radius reduction)",
      2.0f / 3,
      {0.01f, 1},
      "Raising it shrinks the radius more slowly: noise falls faster, bias more slowly. 1 keeps the radius constant"};
  Number<float> radius{"radius",
                       "Initial radius",
                       4,
                       {0.1f, 1000},
                       "Lookup radius of the first sample, in pixels at the visible surface",
                       "px",
                       Scale::logarithmic};
  Number<float> volume_radius{"volume-radius",
                              "Initial radius in media",
                              0.03f,
                              {1e-5f, 1},
                              "Lookup radius of the first sample at collisions in media, as a fraction of the scene's "
                              "diameter. Raising it reduces noise and blurs light",
                              "",
                              Scale::logarithmic};
  Toggle connect{"connect", "Sample lights directly", true,
                 "Estimates direct light with shadow rays; otherwise it comes from the photon map, which is "
                 "noisier"};
  Number<float> roughness{"roughness",
                          "Max. roughness traced as specular",
                          0.2f,
                          {0, 1},
                          "Glossy lobes below this roughness are ray traced; rougher ones use the photon map"};
  Number<int> roulette_start{
      "roulette-start",
      "Russian roulette start depth",
      4,
      {1, 64},
      "Length of camera paths from which they are terminated at random. Lower is faster and noisier"};

  using IntegratorBase::at_max_depth;

  auto parameters() {
    return std::tie(max_depth, photons, alpha, radius, volume_radius, connect, roughness, roulette_start);
  }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const final;

  // `scattering`: the scene has media that scatter.
  PhotonPlan plan(int pixels, bool scattering) const {
    PhotonPlan plan;
    plan.photons = max_depth == 1 ? 0 : photons > 0 ? photons : pixels;
    plan.split = transport::LobeSplit(roughness);
    plan.min_length = connect ? 2 : 1;
    if (scattering) plan.min_volume_length = plan.min_length;
    plan.max_length = std::max(0, max_depth - 1);
    return plan;
  }
};
namespace {

class State final : public RenderState {
 public:
  State(const ProgressivePhotonMapping& integrator, const RenderContext& context)
      : integrator_(integrator),
        context_(context),
        footprint_(*context.camera, context.width, context.height),
        emission_(integrator.plan(context.width * context.height, context.model->scattering), 0) {
    if (context.model->classes) join_.emplace(*context.model->paths);
  }

  std::vector<Phase> phases(uint32_t sample) override {
    emission_.begin(emission_.plan(), sample);
    const double ratio = region_ratio(double{integrator_.alpha}, sample / film::kHalfBuffers);
    radius_ = integrator_.radius * static_cast<float>(std::sqrt(ratio));
    const float diameter = 2 * context_.scene->bounds().radius();
    volume_radius_ = integrator_.volume_radius * diameter * static_cast<float>(std::cbrt(ratio));
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
    return transport::with_scattering_model(*context_.model,
                                            [&]<class M>(M) { return sample_with<M>(block, radiance, task_context); });
  }

  size_t memory() const override { return emission_.memory(); }

  std::shared_ptr<const std::vector<StoredPoint>> points() const override {
    auto points = std::make_shared<std::vector<StoredPoint>>();
    if (emission_.is_ready()) add_points(emission_, kMostPoints, *points);
    return points;
  }

 private:
  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) const {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    const PixelOrder order(block);
    launch_camera_paths(at_shared_time(context_, block.sample), block, order, task_context, paths);
    paths.stratify_channels();
    estimate(paths, task_context.overhead_timer);
    return collect(paths, order, radiance);
  }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths, Stopwatch* watch) const {
    using namespace transport;
    const PhotonView view{.map = &emission_.map(),
                          .split = emission_.plan().split,
                          .join = join_ ? &*join_ : nullptr,
                          .max_length = integrator_.max_depth,
                          .watch = watch,
                          .volume_map = emission_.volume_map()};
    static thread_local std::array<float, PathWavefront<M>::kCapacity> path_lengths;  // metres
    path_lengths.fill(0);
    const auto radius2 = [&](int i) {
      return sqr(radius_ * footprint_.over(path_lengths[static_cast<size_t>(paths.path_at(i))]));
    };
    ShallowCollisions<M> shallow(paths);
    DirectLightByLobe<M> direct_light(paths, view.split, shallow);
    EmissionOfMedia<M> media(paths);
    while (paths.trace()) {
      media.add_emission_of_misses();
      add_environment(paths, kLobeSplitHeuristic);
      if (integrator_.connect && !integrator_.at_max_depth(paths.length())) direct_light.add_on_misses();
      while (paths.next_hits()) {
        media.add_emission_before_hits();
        add_emission(paths, kLobeSplitHeuristic);
        shallow.begin_hits();
        if (integrator_.at_max_depth(paths.length())) continue;
        for (int i = 0; i < paths.hit_count(); ++i)
          path_lengths[static_cast<size_t>(paths.path_at(i))] +=
              glm::distance(paths.state_at(i).from, paths.point(i).position);
        add_volume_photons_within(paths, view, sqr(volume_radius_), shallow);
        integrator_.connect ? direct_light.add() : direct_light.add_near_specular();
        add_photons_within(paths, view, radius2);
        continue_near_specular(paths, view.split, shallow, integrator_.roulette_start);
      }
    }
  }

  const ProgressivePhotonMapping& integrator_;
  const RenderContext context_;
  const PixelFootprint footprint_;
  PhotonEmission emission_;
  float radius_ = 0;         // pixels
  float volume_radius_ = 0;  // metres
  std::optional<transport::ClassJoin> join_;
};

}  // namespace

std::unique_ptr<RenderState> ProgressivePhotonMapping::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<State>(*this, context);
}

Registration progressive_photon_mapping() { return registration<ProgressivePhotonMapping>(); }

}  // namespace etendue::integrator
