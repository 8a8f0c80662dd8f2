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
  // yet. begun(start, point of the lens) is called for each, those included that carry nothing.
  template <class NumberOf, class Begun>
  void launch(const Pass& pass, uint32_t sample, int count, const Turn& turn, Front& front, NumberOf&& number_of,
              Begun&& begun) {
    const uint32_t replicate = sample % film::kReplicates;
    front.begin(*pass.scene, *pass.sampler, sample / film::kReplicates, turn.wanted);
    for (int i = 0; i < count; ++i) front.add(light_path_seed(pass.seed, number_of(i), replicate));
    launch_added(pass, front, [&](const Start& start, Vec2 lens) {
      begun(start, lens);
      return true;
    });
  }

  // The same for paths that were added to the front; begun says whether the walk is to go on from its start.
  template <class Begun>
  void launch_added(const Pass& pass, Front& front, Begun&& begun) {
    if constexpr (M::kClasses) front.admit_from_light(*pass.model->paths->from_light());
    const int count = front.size();
    using namespace emission_dimension;
    const SampleTable& random =
        front.draw_start(dimensions(kPoint, 2) | dimensions(kDirection, 2) | dimensions(kChoice, 1) |
                         (pass.camera->has_lens() ? dimensions(kLens, 2) : 0));
    for (int i = 0; i < count; ++i) {
      const auto at = [&](int dimension) {
        return random.values[static_cast<size_t>(dimension)][static_cast<size_t>(i)];
      };
      const Vec2 point(at(kPoint), at(kPoint + 1)), direction(at(kDirection), at(kDirection + 1));
      Start start = start_of(*pass.scene, {at(kChoice), point, direction});
      start.path = i;
      if (begun(start, pass.camera->has_lens() ? Vec2(at(kLens), at(kLens + 1)) : Vec2(0))) launch_one(i, start, front);
    }
  }

  // What the throughput of a walk is to be multiplied by.
  float flux(int path) const { return flux_[static_cast<size_t>(path)]; }
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
  static Start start_of(const scene::CompiledScene& scene, const EmissionDraw& draw) {
    Start start;
    start.emission = scene.lights().emit(draw);
    Emission& e = start.emission;
    if (!(e.per_density > 0)) return start;
    if (e.kind == LightKind::triangle) {
      start.point = scene.point_of(e);
      e.position = start.point.position;
      e.direction = Frame(start.point.front ? start.point.ng : -start.point.ng).to_world(e.direction);
    }
    start.emitted = scene.emitted(e, start.point);
    return start;
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
    front.launch(i, ray);
    front.state(i).throughput = flux / most;
    front.state(i).from = e.position;
  }

  std::array<float, Front::kCapacity> flux_;
  std::array<uint32_t, Front::kCapacity> lights_;
};

}  // namespace etendue::integrator
