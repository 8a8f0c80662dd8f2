#include "integrator/audit/energy.h"

#include "integrator/shared/light_subpaths.h"

namespace etendue::integrator {
namespace {

using Model = transport::ScatteringMedia<false>;
using Paths = transport::PathWavefront<Model>;

constexpr int kRouletteStart = 8;

class EnergyRecorder {
 public:
  EnergyRecorder(Paths& paths, LightSubpaths<Model>& subpaths, double scale, EnergySums& sums)
      : paths_(paths), subpaths_(subpaths), scale_(scale), sums_(sums) {}

  // Emission and the first segments. `nodes` are the nodes of the emitters, by path.
  void start(const std::vector<int>& nodes, const std::vector<bool>& infinite) {
    for (int i = 0; i < paths_.size(); ++i) {
      const auto path = static_cast<size_t>(i);
      flux_[path] = std::max(subpaths_.flux(i), 0.0f) * paths_.state(i).throughput;
      if (nodes[path] >= 0)
        add(sums_.objects[static_cast<size_t>(nodes[path])].emitted, flux_[path]);
      else if (subpaths_.starts_in_medium(i))
        add(sums_.media.emitted, flux_[path]);
      else
        add(infinite[path] ? sums_.environment : sums_.point_lights, flux_[path]);
    }
  }

  // What media absorb on the segments traced last, and what leaves the scene.
  void finish_segments() {
    for (int i = 0; i < paths_.miss_count(); ++i) {
      const int path = paths_.path_of_miss(i);
      add_loss(path);
      if (paths_.length() == 1) apply_range(path, paths_.missed_path(i), kInfinity);
      add(sums_.escaped, flux_of(path));
    }
  }
  void arrive() {
    for (int i = 0; i < paths_.hit_count(); ++i) {
      add_loss(paths_.path_at(i));
      if (paths_.length() == 1) {
        auto& state = paths_.state_at(i);
        apply_range(paths_.path_at(i), state, glm::distance(state.from, paths_.point(i).position));
      }
      if (paths_.in_volume(i)) continue;
      ObjectFlux& object = object_at(i);
      const Rgb flux = flux_of(paths_.path_at(i));
      add(object.received, flux);
      add(object.absorbed, flux);
    }
  }

  // The filter of BSDF samples: takes back what is scattered.
  struct Accept {
    EnergyRecorder* recorder;
    bool operator()(Paths& paths, int hit, LobeSample<Rgb>& s) const {
      if (paths.in_volume(hit)) return true;
      recorder->add(recorder->object_at(hit).absorbed, -1.0f * recorder->flux_of(paths.path_at(hit)) * s.weight);
      return true;
    }
  };
  // The flux with which a path continues.
  void depart(int hit, const LobeSample<Rgb>&) {
    const int path = paths_.path_at(hit);
    flux_[static_cast<size_t>(path)] = flux_of(path);
  }

 private:
  void add(std::array<double, 3>& sum, const Rgb& flux) const {
    for (int c = 0; c < 3; ++c) sum[static_cast<size_t>(c)] += scale_ * double{flux[c]};
  }
  Rgb flux_of(int path) const { return paths_.state(path).throughput * subpaths_.flux(path); }
  ObjectFlux& object_at(int hit) { return sums_.objects[paths_.point(hit).instance->node]; }
  void add_loss(int path) { add(sums_.media.absorbed, flux_[static_cast<size_t>(path)] - flux_of(path)); }
  // The window of the range belongs to the light and not to a medium.
  void apply_range(int path, transport::PathState<Rgb>& state, float distance) {
    const float window = paths_.scene().lights().range_window(subpaths_.light(path), distance);
    if (window == 1) return;
    add(sums_.beyond_range, flux_of(path) * (1 - window));
    state.throughput *= window;
  }

  Paths& paths_;
  LightSubpaths<Model>& subpaths_;
  double scale_;
  EnergySums& sums_;
  std::array<Rgb, Paths::kCapacity> flux_;  // at the start of the current segments
};

}  // namespace

bool add_energy(const RenderContext& context, uint32_t sample, uint32_t first_path, int count,
                const TaskContext& task_context, EnergySums& sums) {
  using namespace transport;
  static thread_local const auto subpaths = std::make_unique<LightSubpaths<Model>>();
  Paths& paths = thread_wavefront<Model>();
  constexpr auto kPaths = static_cast<size_t>(Paths::kCapacity);
  for (int begin = 0; begin < count; begin += Paths::kCapacity) {
    const int size = std::min(Paths::kCapacity, count - begin);
    std::vector<int> nodes(kPaths, -1);
    std::vector<bool> infinite(kPaths, false), has_flux(kPaths, false);
    const auto on_start = [&](const LightSubpaths<Model>::Start& start, Vec2) {
      const auto path = static_cast<size_t>(start.path);
      if (start.point) nodes[path] = static_cast<int>(start.point->instance->node);
      infinite[path] = start.emission.density.infinite;
      has_flux[path] = start.emission.weight > 0 && !is_black(start.emitted);
      return has_flux[path];
    };
    subpaths->launch(
        context, sample, size, task_context, paths,
        [&](int i) { return first_path + static_cast<uint32_t>(begin + i); }, on_start, LightPathStarts::anywhere);
    for (int i = 0; i < size; ++i)
      if (!has_flux[static_cast<size_t>(i)]) paths.state(i).throughput = Rgb(0);
    EnergyRecorder recorder(paths, *subpaths, 1.0 / count, sums);
    recorder.start(nodes, infinite);
    while (paths.length() < kMostVertices && paths.trace()) {
      recorder.finish_segments();
      while (paths.next_hits()) {
        recorder.arrive();
        sample_bsdf_and_record(
            paths, kRouletteStart, TransportMode::importance,
            [&](int hit, const LobeSample<Rgb>& s) { recorder.depart(hit, s); }, EnergyRecorder::Accept{&recorder});
      }
    }
    if (paths.cancelled()) return false;
  }
  return true;
}

}  // namespace etendue::integrator
