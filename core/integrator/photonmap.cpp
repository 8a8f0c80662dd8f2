#include "integrator/photonmap.h"

#include "integrator/final_gather.h"
#include "integrator/photon_emission.h"
#include "sampling/random.h"

namespace etendue::integrator {

// Of each half of the film, a global map and one of caustics.
class PhotonMapping::Maps final : public Work {
 public:
  Maps(const PhotonMapping& method, const Pass& pass, const Maps* previous)
      : method_(method), pass_(pass), size_(2 * pass.scene->bounds().radius()) {
    if (pass.model->classes) join_.emplace(*pass.model->paths);
    const bool reusable = previous && !renews() && !previous->renews() && previous->same_light(pass);
    for (uint32_t half = 0; half < film::kReplicates; ++half)
      for (const bool caustics : {false, true}) {
        if (caustics && (method.direct() || pass.model->diffuse)) continue;
        auto& mine = emissions_[half][caustics];
        const PhotonPlan plan = method.plan(caustics);
        if (reusable) mine = previous->emissions_[half][caustics];
        if (!mine || !(mine->plan() == plan)) mine = std::make_shared<PhotonEmission>(plan, half);
      }
  }

  std::vector<Phase> phases(uint32_t sample) override {
    std::vector<Phase> phases;
    running_.clear();
    for (const auto& emission : emissions_[sample % film::kReplicates]) {
      if (!emission) continue;
      if (renews()) emission->begin(emission->plan(), sample);
      if (emission->ready()) continue;
      emission->add_phases(phases);
      running_.push_back(emission.get());
    }
    return phases;
  }

  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const Turn& turn) override {
    Pass pass = at_one_moment(pass_, sample);
    if (!renews()) pass.sampler = &random_;
    return running_[phase / 2]->run(pass, static_cast<PhotonEmission::Step>(phase % 2), task, turn);
  }
  void finish(uint32_t, size_t phase) override {
    running_[phase / 2]->finish(static_cast<PhotonEmission::Step>(phase % 2));
  }

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance, const Turn& turn) override {
    return transport::with_model(*pass_.model, [&]<class M>(M) { return sample_with<M>(block, radiance, turn); });
  }

  size_t memory() const override {
    size_t bytes = 0;
    for (const auto& half : emissions_)
      for (const auto& emission : half) bytes += emission ? emission->memory() : 0;
    return bytes;
  }

  std::shared_ptr<const std::vector<PointOfLight>> points() const override {
    auto points = std::make_shared<std::vector<PointOfLight>>();
    for (const auto& emission : emissions_[0])
      if (emission && emission->ready()) add_points(emission->map(), kMostPoints / 2, *points);
    return points;
  }

 private:
  // What moves needs photons of its own time.
  bool renews() const { return method_.renew || pass_.model->moving; }

  bool same_light(const Pass& pass) const {
    const transport::Model &a = *pass_.model, &b = *pass.model;
    return pass.seed == pass_.seed && a.diffuse == b.diffuse && a.wide == b.wide && a.absorbing == b.absorbing && a.classes == b.classes &&
           (!a.classes || a.paths->automaton() == b.paths->automaton()) && pass.scene->same_light(*pass_.scene);
  }

  PhotonView view(uint32_t sample, bool caustics, const Turn& turn) const {
    const auto& emission = emissions_[sample % film::kReplicates][caustics];
    return {emission ? &emission->map() : nullptr, method_.split(), join_ ? &*join_ : nullptr, method_.max_depth,
            turn.bookkeeping};
  }

  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance, const Turn& turn) const {
    transport::Front<M>& front = front_of_thread<M>();
    const BlockOrder order(block);
    launch_camera_walks(at_one_moment(pass_, block.sample), block, order, turn, front);
    if (method_.direct()) {
      if (!estimate_directly(view(block.sample, false, turn), turn, front)) return {};
      return collect(front, order, radiance);
    }
    static thread_local const auto gatherer = std::make_unique<FinalGather<M>>();
    gatherer->begin({view(block.sample, false, turn), method_.nearest_of(method_.photons, size_)},
                    {view(block.sample, true, turn), method_.nearest_of(method_.caustic_photons, size_)},
                    method_.gather, method_.near * size_);
    if (!estimate_in_terms(turn, *gatherer, front)) return {};
    const auto rays = collect(front, order, radiance);
    if (!rays || gatherer->given_up()) return {};
    return *rays + gatherer->rays_traced();
  }

  // False if nobody wants it any more: lookups take a while.
  template <class M>
  bool estimate_directly(const PhotonView& view, const Turn& turn, transport::Front<M>& front) const {
    using namespace transport;
    while (front.advance()) {
      add_environment(front, kPartsHeuristic);
      while (front.arrive()) {
        if (!is_wanted(turn)) return false;
        add_emission(front, kPartsHeuristic);
        if (method_.at_limit(front.length())) continue;
        add_light_by_parts(front, view.split, LitParts::narrow);
        add_nearest_photons(front, view, method_.nearest_of(method_.photons, size_), 0);
        scatter(front, method_.roulette_start, Transport::radiance, TakeNarrow{view.split});
      }
    }
    return true;
  }

  template <class M>
  bool estimate_in_terms(const Turn& turn, FinalGather<M>& gatherer, transport::Front<M>& front) const {
    using namespace transport;
    const LobeSplit split = method_.split();
    while (front.advance()) {
      add_environment(front, kPartsHeuristic);
      while (front.arrive()) {
        if (!is_wanted(turn)) return false;
        add_emission(front, kPartsHeuristic);
        if (method_.at_limit(front.length())) continue;
        add_light_by_parts(front, split, LitParts::both);
        gatherer.add_caustics(front);
        gatherer.gather(pass_, turn, front);
        scatter(front, method_.roulette_start, Transport::radiance, TakeNarrow{split});
      }
    }
    return true;
  }

  const PhotonMapping& method_;
  const Pass pass_;
  const float size_;  // of the scene
  const RandomSampler random_;
  std::optional<transport::ClassJoin> join_;
  std::array<std::array<std::shared_ptr<PhotonEmission>, 2>, film::kReplicates> emissions_;
  std::vector<PhotonEmission*> running_;  // one for two phases
};

std::unique_ptr<Work> PhotonMapping::begin(const Pass& pass, const Work* previous) const {
  return std::make_unique<Maps>(*this, pass, dynamic_cast<const Maps*>(previous));
}

}  // namespace etendue::integrator
