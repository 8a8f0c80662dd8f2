// Walks that start on lights.                                              thesis 9.2, (9.33)-(9.35), errata E18, E19
//
// A walk's throughput is the flux that it carries over what it started with, so that roulette plays for what scattering
// did; `flux` is what it started with, in watts.
#pragma once
#include "integrator/camera_walks.h"
#include "transport/gather.h"

namespace etendue::integrator {

// The seed of a light path's random numbers in one half of the film.
inline uint32_t light_path_seed(uint64_t seed, uint32_t path, uint32_t replicate) {
  constexpr uint64_t kNoPixel = 0x6c62272e07bb0142;
  return static_cast<uint32_t>(mix_bits(mix_bits(seed * film::kReplicates + replicate + kNoPixel) ^ path) >> 32);
}

template <class M>
class LightWalks {
 public:
  using Front = transport::Front<M>;
  using Color = typename M::Color;

  // Where a walk starts. `point` belongs to triangles only.
  struct Start {
    int path = 0;
    Emission emission;
    scene::SurfacePoint point;
    Color emitted{0};
  };

  // Lets so many paths of a sample go, number_of(i) being the i-th one's among all; on return nothing has been traced
  // yet. begun(start, point of the lens) is called for each, those included that carry nothing, and says whether the
  // walk is to go on from there.
  template <class NumberOf, class Begun>
  void launch(const Pass& pass, uint32_t sample, int count, const Turn& turn, Front& front, NumberOf&& number_of,
              Begun&& begun) {
    const uint32_t replicate = sample % film::kReplicates;
    front.begin(*pass.scene, *pass.sampler, sample / film::kReplicates, turn.wanted, pass.model->moving);
    for (int i = 0; i < count; ++i) front.add(light_path_seed(pass.seed, number_of(i), replicate));
    launch_added(pass, front, begun);
  }

  // The same for paths that were added to the front.
  template <class Begun>
  void launch_added(const Pass& pass, Front& front, Begun&& begun) {
    if constexpr (M::kClasses) front.admit_from_light(*pass.model->paths->from_light());
    const int count = front.size();
    using namespace emission_dimension;
    const SampleTable& random = front.draw_start(
        dimensions(kPoint, 2) | dimensions(kDirection, 2) | dimensions(kChoice, 1) |
        (pass.camera->has_lens() ? dimensions(kLens, 2) : 0) | (pass.draws_times() ? dimensions(kTime, 1) : 0));
    const auto at = [&](int i, int dimension) {
      return random.values[static_cast<size_t>(dimension)][static_cast<size_t>(i)];
    };
    const auto pair = [&](int i, int dimension) { return Vec2(at(i, dimension), at(i, dimension + 1)); };
    for (int first = 0; first < count; first += kBatch) {
      const int size = std::min(kBatch, count - first);
      for (int k = 0; k < size; ++k) {
        const int i = first + k;
        const float time = pass.draws_times() ? at(i, kTime) : pass.moment.value_or(0.0f);
        times_[static_cast<size_t>(i)] = time;
        Start& start = starts_[static_cast<size_t>(k)];
        start.path = i;
        start.emission = pass.scene->lights().emit({at(i, kChoice), pair(i, kPoint), pair(i, kDirection), time});
      }
      finish_starts(*pass.scene, size);
      for (int k = 0; k < size; ++k) {
        const Start& start = starts_[static_cast<size_t>(k)];
        if (begun(start, pass.camera->has_lens() ? pair(start.path, kLens) : Vec2(0)))
          launch_one(start.path, start, front);
      }
    }
  }

  // What the throughput of a walk is to be multiplied by.
  float flux(int path) const { return flux_[static_cast<size_t>(path)]; }
  // Of all walks, those included that carry nothing.
  const float* times() const { return times_.data(); }
  // The number of the light that a walk started on.
  uint32_t light(int path) const { return lights_[static_cast<size_t>(path)]; }

  // Point lights may lose light with the distance: to be called before anything else is done with the first vertices.
  void dim_first_vertices(Front& front) const {
    for (int i = 0; i < front.arrived(); ++i) {
      auto& path = front.state_at(i);
      path.throughput *=
          front.scene().lights().window(light(front.path_at(i)), glm::distance(path.from, front.point(i).position));
    }
  }

 private:
  // Where they are, and what they send out: many at once, because surfaces are looked at many at once.
  void finish_starts(const scene::CompiledScene& scene, int size) {
    std::array<Hit, kBatch> hits;
    std::array<Vec3, kBatch> sides;
    std::array<float, kBatch> times{};
    std::array<int, kBatch> of;
    size_t count = 0;
    for (int k = 0; k < size; ++k) {
      const Emission& e = starts_[static_cast<size_t>(k)].emission;
      if (!(e.per_density > 0) || e.kind != LightKind::triangle) continue;
      scene.locate(e, hits[count], sides[count]);
      times[count] = e.time;
      of[count++] = k;
    }
    scene.surfaces({sides.data(), count}, {hits.data(), count}, points_.data(), times.data());
    for (size_t n = 0; n < count; ++n) {
      Start& start = starts_[static_cast<size_t>(of[n])];
      start.point = points_[n];
      start.emission.position = start.point.position;
      const Vec3 out = start.point.front ? start.point.ng : -start.point.ng;
      start.emission.direction = Frame(out).to_world(start.emission.direction);
    }
    for (int k = 0; k < size; ++k) {
      Start& start = starts_[static_cast<size_t>(k)];
      start.emitted = start.emission.per_density > 0 ? Color(scene.emitted(start.emission, start.point)) : Color(0);
    }
  }

  void launch_one(int i, const Start& start, Front& front) {
    const Emission& e = start.emission;
    const Color flux = start.emitted * e.per_density;
    const float most = max_component(flux);
    flux_[static_cast<size_t>(i)] = most, lights_[static_cast<size_t>(i)] = e.light;
    if (!(most > 0)) return;
    Ray ray;
    ray.origin = e.position, ray.direction = e.direction;
    if (e.kind == LightKind::triangle) start.point.spawn(e.direction, ray);
    front.launch(i, ray, e.time);
    front.state(i).throughput = flux / most;
    front.state(i).from = e.position;
  }

  static constexpr int kBatch = 64;

  std::array<Start, kBatch> starts_;
  std::array<scene::SurfacePoint, kBatch> points_;
  std::array<float, Front::kCapacity> flux_, times_;
  std::array<uint32_t, Front::kCapacity> lights_;
};

}  // namespace etendue::integrator
