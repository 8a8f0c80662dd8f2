// Walks that start on lights.                                              thesis 9.2, (9.33)-(9.35), errata E18, E19
//
// A walk's throughput is the flux that it carries over what it started with, so that roulette plays for what scattering
// did; `flux` is what it started with, in watts.
#pragma once
#include "integrator/shared/camera_paths.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::integrator {

// The seed of a light path's random numbers in one half of the film.
inline uint32_t light_path_seed(uint64_t seed, uint32_t path, uint32_t half_buffer) {
  constexpr uint64_t kNoPixel = 0x6c62272e07bb0142;
  return static_cast<uint32_t>(mix_bits(mix_bits(seed * film::kHalfBuffers + half_buffer + kNoPixel) ^ path) >> 32);
}

template <class M>
class LightSubpaths {
 public:
  using PathWavefront = transport::PathWavefront<M>;
  using Color = typename M::Color;

  // Where a walk starts.
  struct Start {
    int path = 0;
    Emission emission;
    const scene::SurfacePoint* point = nullptr;  // of triangles only
    Color emitted{0};
    [[no_unique_address]] std::conditional_t<M::kMedia, scene::MediumInterface, transport::Vacuum> media;

    // The solids at the start of a ray that leaves in this direction.
    transport::MediumState<M> medium_beyond(const Vec3& direction) const {
      if constexpr (M::kMedia)
        return media.side(!point || glm::dot(point->ng, direction) >= 0);
      else
        return {};
    }
  };

  // Lets so many paths of a sample go, number_of(i) being the i-th one's among all; on return nothing has been traced
  // yet. begun(start, point of the lens) is called for each, those included that carry nothing, and says whether the
  // walk is to go on from there.
  template <class NumberOf, class Begun>
  void launch(const RenderContext& context, uint32_t sample, int count, const TaskContext& task_context,
              PathWavefront& paths, NumberOf&& number_of, Begun&& begun) {
    const uint32_t half_buffer = sample % film::kHalfBuffers;
    paths.begin(*context.scene, *context.sampler, sample / film::kHalfBuffers, task_context.keep_going,
                context.model->moving);
    for (int i = 0; i < count; ++i) paths.add(light_path_seed(context.seed, number_of(i), half_buffer));
    launch_added(context, paths, begun, [](int) { return true; });
  }

  // The same for paths that were added to the front; those stay behind, and are not begun, for which wanted(path) says
  // no.
  template <class Begun, class Wanted>
  void launch_added(const RenderContext& context, PathWavefront& paths, Begun&& begun, Wanted&& keep_going) {
    if constexpr (M::kClasses) paths.filter_paths_from_light(*context.model->paths->from_light());
    const int count = paths.size();
    using namespace emission_dimension;
    const SampleTable& random = paths.draw_start(
        dimensions(kPoint, 2) | dimensions(kDirection, 2) | dimensions(kChoice, 1) |
        (context.camera->has_lens() ? dimensions(kLens, 2) : 0) | (context.samples_time() ? dimensions(kTime, 1) : 0));
    const auto at = [&](int i, int dimension) {
      return random.values[static_cast<size_t>(dimension)][static_cast<size_t>(i)];
    };
    const auto pair = [&](int i, int dimension) { return Vec2(at(i, dimension), at(i, dimension + 1)); };
    for (int first = 0; first < count; first += kBatch) {
      const int end = std::min(first + kBatch, count);
      squares_to_cosine_hemisphere(&random.values[kDirection][static_cast<size_t>(first)],
                                   &random.values[kDirection + 1][static_cast<size_t>(first)],
                                   static_cast<size_t>(end - first), cosine_directions_);
      int size = 0;
      for (int i = first; i < end; ++i) {
        const float time = context.samples_time() ? at(i, kTime) : context.shared_time.value_or(0.0f);
        times_[static_cast<size_t>(i)] = time;
        if (!keep_going(i)) continue;
        Start& start = starts_[static_cast<size_t>(size++)];
        start.path = i, start.point = nullptr;
        start.emission = {};
        context.scene->lights().sample_emission({at(i, kChoice), pair(i, kPoint), pair(i, kDirection), time,
                                                 cosine_directions_[static_cast<size_t>(i - first)]},
                                                start.emission);
      }
      finish_starts(*context.scene, size);
      for (int k = 0; k < size; ++k) {
        const Start& start = starts_[static_cast<size_t>(k)];
        if (begun(start, context.camera->has_lens() ? pair(start.path, kLens) : Vec2(0))) launch_one(k, paths);
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
  void dim_first_vertices(PathWavefront& paths) const {
    for (int i = 0; i < paths.hit_count(); ++i) {
      auto& path = paths.state_at(i);
      path.throughput *= paths.scene().lights().range_window(light(paths.path_at(i)),
                                                             glm::distance(path.from, paths.point(i).position));
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
      if (!(e.weight > 0) || e.kind != LightKind::triangle) continue;
      scene.locate(e, hits[count], sides[count]);
      times[count] = e.time;
      of[count++] = k;
    }
    scene.surfaces({sides.data(), count}, {hits.data(), count}, points_.data(), times.data());
    for (size_t n = 0; n < count; ++n) {
      Start& start = starts_[static_cast<size_t>(of[n])];
      start.point = &points_[n];
      start.emission.position = points_[n].position;
      const Vec3 out = points_[n].front ? points_[n].ng : -points_[n].ng;
      start.emission.direction = Frame(out).to_world(start.emission.direction);
    }
    for (int k = 0; k < size; ++k) find_ray(scene, k);
  }

  // What a start sends out, and along which ray.
  void find_ray(const scene::CompiledScene& scene, int k) {
    Start& start = starts_[static_cast<size_t>(k)];
    const Emission& e = start.emission;
    start.emitted = e.weight > 0 ? Color(scene.emitted(e, start.point)) : Color(0);
    Ray& ray = rays_[static_cast<size_t>(k)];
    ray = Ray();
    ray.origin = e.position, ray.direction = e.direction;
    if (start.point) start.point->spawn(e.direction, ray);
    if constexpr (M::kMedia)
      if (e.weight > 0) scene.find_media_at_light(e, start.point, ray.origin, start.media);
  }

  void launch_one(int k, PathWavefront& paths) {
    const Start& start = starts_[static_cast<size_t>(k)];
    const Emission& e = start.emission;
    const auto path = static_cast<size_t>(start.path);
    const float beam = start.point ? start.point->beam(e.direction) : 1;
    const Color flux = start.emitted * (e.weight * beam);
    const float most = max_component(flux);
    flux_[path] = most, lights_[path] = e.light;
    if (!(most > 0)) return;
    paths.launch(start.path, rays_[static_cast<size_t>(k)], start.medium_beyond(e.direction), e.time);
    paths.state(start.path).throughput = flux / most;
    paths.state(start.path).from = e.position;
  }

  static constexpr int kBatch = 64;

  std::array<Start, kBatch> starts_;
  std::array<scene::SurfacePoint, kBatch> points_;
  Vec3Lanes<kBatch> cosine_directions_;
  std::array<Ray, kBatch> rays_;
  std::array<float, PathWavefront::kCapacity> flux_, times_;
  std::array<uint32_t, PathWavefront::kCapacity> lights_;
};

}  // namespace etendue::integrator
