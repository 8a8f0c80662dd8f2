#include "integrator/sppm.h"

#include "integrator/photon_emission.h"
#include "integrator/photon_lookup.h"

namespace etendue::integrator {
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

class Progress final : public Work {
 public:
  Progress(const ProgressivePhotonMapping& method, const Pass& pass)
      : method_(method),
        pass_(pass),
        footprint_(*pass.camera, pass.width, pass.height),
        emission_(method.plan(pass.width * pass.height), 0) {
    if (pass.model->classes) join_.emplace(*pass.model->paths);
  }

  std::vector<Phase> phases(uint32_t sample) override {
    emission_.begin(emission_.plan(), sample);
    radius_ = method_.radius * static_cast<float>(std::sqrt(method_.shrinking(sample / film::kReplicates)));
    std::vector<Phase> phases;
    emission_.add_phases(phases);
    return phases;
  }
  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const Turn& turn) override {
    return emission_.run(at_one_moment(pass_, sample), static_cast<PhotonEmission::Step>(phase), task, turn);
  }
  void finish(uint32_t, size_t phase) override { emission_.finish(static_cast<PhotonEmission::Step>(phase)); }

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance, const Turn& turn) override {
    return transport::with_model(*pass_.model, [&]<class M>(M) { return sample_with<M>(block, radiance, turn); });
  }

  size_t memory() const override { return emission_.memory(); }

  std::shared_ptr<const std::vector<PointOfLight>> points() const override {
    auto points = std::make_shared<std::vector<PointOfLight>>();
    if (emission_.ready()) add_points(emission_.map(), kMostPoints, *points);
    return points;
  }

 private:
  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance, const Turn& turn) const {
    transport::Front<M>& front = front_of_thread<M>();
    const BlockOrder order(block);
    launch_camera_walks(at_one_moment(pass_, block.sample), block, order, turn, front);
    estimate(front, turn.bookkeeping);
    return collect(front, order, radiance);
  }

  template <class M>
  void estimate(transport::Front<M>& front, Stopwatch* watch) const {
    using namespace transport;
    const PhotonView view{&emission_.map(), emission_.plan().split, join_ ? &*join_ : nullptr, method_.max_depth,
                          watch};
    static thread_local std::array<float, Front<M>::kCapacity> walked;  // metres, of each path
    walked.fill(0);
    const auto radius2 = [&](int i) {
      return sqr(radius_ * footprint_.over(walked[static_cast<size_t>(front.path_at(i))]));
    };
    while (front.advance()) {
      add_environment(front, kPartsHeuristic);
      while (front.arrive()) {
        add_emission(front, kPartsHeuristic);
        if (method_.at_limit(front.length())) continue;
        for (int i = 0; i < front.arrived(); ++i)
          walked[static_cast<size_t>(front.path_at(i))] +=
              glm::distance(front.state_at(i).from, front.point(i).position);
        add_light_by_parts(front, view.split, method_.connect ? LitParts::both : LitParts::narrow);
        add_photons_within(front, view, radius2);
        scatter(front, method_.roulette_start, Transport::radiance, TakeNarrow{view.split});
      }
    }
  }

  const ProgressivePhotonMapping& method_;
  const Pass pass_;
  const Footprint footprint_;
  PhotonEmission emission_;
  float radius_ = 0;  // pixels
  std::optional<transport::ClassJoin> join_;
};

}  // namespace

std::unique_ptr<Work> ProgressivePhotonMapping::begin(const Pass& pass, const Work*) const {
  return std::make_unique<Progress>(*this, pass);
}

}  // namespace etendue::integrator
