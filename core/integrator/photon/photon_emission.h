// An emission of photons and their tree, built in two phases of tasks.
//
// An emission can be shared by several render states: what one of them has traced is complete for the others, so that
// building continues after an edit of the camera has interrupted it.
#pragma once
#include "integrator/photon/photon_map.h"
#include "integrator/photon/photon_paths.h"

namespace etendue::integrator {

class PhotonEmission {
 public:
  // The photons depend on the plan and the sample number, and on the scene, the model and the seed. If their random
  // numbers come from the sampler, they must be traced while the sampler has tables for that sample.
  PhotonEmission(const PhotonPlan& plan, uint32_t sample) { begin(plan, sample); }

  // Starts another emission.
  void begin(const PhotonPlan& plan, uint32_t sample) {
    plan_ = plan;
    sample_ = sample;
    photons_by_task_.resize(static_cast<size_t>(plan.tasks()));
    is_traced_.assign(photons_by_task_.size(), 0);
    is_ordered_.fill(0);
    is_collected_ = is_ready_ = false;
  }

  bool is_ready() const { return is_ready_; }
  const photon::PhotonMap& map() const { return map_; }
  // The photons at collisions in media; null if none are stored.
  const photon::PhotonMap* volume_map() const { return plan_.min_volume_length > 0 ? &volume_map_ : nullptr; }
  const PhotonPlan& plan() const { return plan_; }

  enum Step : size_t { kTrace, kBuild };
  void add_phases(std::vector<Phase>& phases) const {
    phases.push_back({plan_.caustics ? "tracing caustic photons" : "tracing photons", plan_.tasks()});
    phases.push_back({"ordering photons", plan_.min_volume_length > 0 ? 2 * kPieces : kPieces});
  }

  std::optional<uint64_t> run(const RenderContext& context, Step step, int task, const TaskContext& task_context) {
    char& done = step == kTrace ? is_traced_[static_cast<size_t>(task)] : is_ordered_[static_cast<size_t>(task)];
    if (done) return 0;
    std::optional<uint64_t> rays = 0;
    if (step == kBuild)
      task < kPieces ? map_.build_piece(task) : volume_map_.build_piece(task - kPieces);
    else
      rays = transport::with_scattering_model(*context.model, [&]<class M>(M) {
        return trace_photons<M>(context, sample_, plan_, task, task_context,
                                photons_by_task_[static_cast<size_t>(task)]);
      });
    done = rays.has_value();
    return rays;
  }

  // Called after the last task of a step, while no other task runs.
  void finish(Step step) {
    if (step == kBuild) {
      map_.end();
      volume_map_.end();
      is_ready_ = true;
    } else if (!is_collected_)
      collect();
  }

  size_t memory() const {
    size_t photons = 0;
    for (const StoredPhotons& stored : photons_by_task_)
      photons += stored.surfaces.capacity() + stored.volumes.capacity();
    return photons * sizeof(photon::Photon) + map_.memory() + volume_map_.memory();
  }

 private:
  static constexpr int kPieces = photon::PhotonMap::kPieces;

  void collect() {
    begin_map(map_, &StoredPhotons::surfaces);
    begin_map(volume_map_, &StoredPhotons::volumes);
    is_collected_ = true;
  }
  void begin_map(photon::PhotonMap& map, std::vector<photon::Photon> StoredPhotons::*kind) {
    std::vector<photon::Photon> all;
    size_t count = 0;
    for (const StoredPhotons& stored : photons_by_task_) count += (stored.*kind).size();
    all.reserve(count);
    for (StoredPhotons& stored : photons_by_task_) {
      std::vector<photon::Photon>& list = stored.*kind;
      all.insert(all.end(), list.begin(), list.end());
      std::vector<photon::Photon>().swap(list);
    }
    map.begin(std::move(all));
  }

  PhotonPlan plan_;
  uint32_t sample_ = 0;
  std::vector<StoredPhotons> photons_by_task_;
  std::vector<char> is_traced_;
  std::array<char, size_t{2} * photon::PhotonMap::kPieces> is_ordered_{};
  bool is_collected_ = false, is_ready_ = false;
  photon::PhotonMap map_, volume_map_;
};

// Appends up to `max_count` photons of a map at regular intervals, for display.
inline void add_points(const photon::PhotonMap& map, size_t max_count, std::vector<StoredPoint>& points) {
  const size_t stride = std::max<size_t>(1, (map.size() + max_count - 1) / std::max<size_t>(1, max_count));
  for (size_t i = 0; i < map.size(); i += stride) points.push_back({map[i].position(), map[i].power()});
}
// The same for both maps of an emission.
inline void add_points(const PhotonEmission& emission, size_t max_count, std::vector<StoredPoint>& points) {
  const photon::PhotonMap* volume = emission.volume_map();
  add_points(emission.map(), volume ? max_count / 2 : max_count, points);
  if (volume) add_points(*volume, max_count / 2, points);
}

}  // namespace etendue::integrator
