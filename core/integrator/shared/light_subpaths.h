// Subpaths that start on lights.                                             [Lang, sec. 9.2, eq. 9.33-9.35, corrected]
//
// The throughput of a subpath is its flux relative to the flux at its start, so that Russian roulette depends on
// scattering alone. `flux` is the flux at the start, in lumens.
#pragma once
#include "integrator/shared/camera_paths.h"
#include "integrator/shared/emission_starts.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::integrator {

// The seed of a light path's random numbers in one half-buffer.
inline uint32_t light_path_seed(uint64_t seed, uint32_t path, uint32_t half_buffer) {
  constexpr uint64_t kNoPixel = 0x6c62272e07bb0142;
  return static_cast<uint32_t>(mix_bits(mix_bits(seed * film::kHalfBuffers + half_buffer + kNoPixel) ^ path) >> 32);
}

// Where subpaths start: on lights, or also in media that emit.
enum class LightPathStarts : uint8_t { on_lights, anywhere };

template <class M>
class LightSubpaths {
 public:
  using PathWavefront = transport::PathWavefront<M>;
  using Color = typename M::Color;

  // The first vertex of a subpath.
  struct Start {
    int path = 0;
    Emission emission;
    const scene::SurfacePoint* point = nullptr;  // area lights only
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

  // Launches `count` subpaths of a sample; number_of(i) is the index of the i-th among all subpaths of the sample. No
  // ray has been traced on return. on_start(start, lens sample) is called for each subpath, including those of zero
  // flux, and returns whether the subpath is traced.
  template <class NumberOf, class OnStart>
  void launch(const RenderContext& context, uint32_t sample, int count, const TaskContext& task_context,
              PathWavefront& paths, NumberOf&& number_of, OnStart&& on_start,
              LightPathStarts where = LightPathStarts::on_lights) {
    const uint32_t half_buffer = sample % film::kHalfBuffers;
    paths.begin(*context.scene, *context.sampler, sample / film::kHalfBuffers, task_context.keep_going,
                context.model->moving);
    for (int i = 0; i < count; ++i) paths.add(light_path_seed(context.seed, number_of(i), half_buffer));
    launch_added(
        context, paths, on_start, [](int) { return true; }, where);
  }

  // Launches the paths that have been added to the wavefront and for which is_selected(path) holds.
  template <class OnStart, class Selected>
  void launch_added(const RenderContext& context, PathWavefront& paths, OnStart&& on_start, Selected&& is_selected,
                    LightPathStarts where = LightPathStarts::on_lights) {
    const float media_share = where == LightPathStarts::anywhere ? share_of_media(*context.scene) : 0;
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
        if (!is_selected(i)) continue;
        Start& start = starts_[static_cast<size_t>(size++)];
        start.path = i;
        start.point = nullptr;
        start.emission = {};
        const EmissionRandom numbers(at(i, kChoice), pair(i, kPoint), pair(i, kDirection), time,
                                     cosine_directions_[static_cast<size_t>(i - first)]);
        if constexpr (M::kScattering)
          if (media_share > 0) {
            start_anywhere(*context.scene, numbers, media_share, paths.opacity_seed(i), start);
            continue;
          }
        context.scene->lights().sample_emission(numbers, start.emission);
      }
      finish_starts(*context.scene, size);
      for (int k = 0; k < size; ++k) {
        const Start& start = starts_[static_cast<size_t>(k)];
        if (on_start(start, context.camera->has_lens() ? pair(start.path, kLens) : Vec2(0))) launch_one(k, paths);
      }
    }
  }

  // The flux at the start of a subpath: the throughput is relative to it.
  float flux(int path) const { return flux_[static_cast<size_t>(path)]; }
  // The times of all subpaths, including those of zero flux.
  const float* times() const { return times_.data(); }
  // The index of the light on which a subpath started; kNotALight in a medium.
  uint32_t light(int path) const { return lights_[static_cast<size_t>(path)]; }
  bool starts_in_medium(int path) const { return M::kScattering && light(path) == scene::InstanceData::kNotALight; }

  // Applies the range of point lights (KHR_lights_punctual) to the first segments. To be called before the first
  // vertices are processed further.
  void apply_range_window(PathWavefront& paths) const {
    for (int i = 0; i < paths.hit_count(); ++i) {
      auto& path = paths.state_at(i);
      path.throughput *= paths.scene().lights().range_window(light(paths.path_at(i)),
                                                             glm::distance(path.from, paths.point(i).position));
    }
  }

 private:
  // Starts on a light or in a medium. `seed` gives a further random number.
  static void start_anywhere(const scene::CompiledScene& scene, const EmissionRandom& random, float media_share,
                             uint32_t seed, Start& start) {
    scene::MediumStack stack;
    sample_start(scene, random, to_unit_float(mix_bits(seed + 0x9e3779b9U)), media_share, start.emission, stack);
    if constexpr (M::kMedia)
      if (start.emission.kind == LightKind::medium) start.media.clear(stack);
  }

  // Computes positions and emission of a batch of starts; surface points are evaluated in batches.
  void finish_starts(const scene::CompiledScene& scene, int size) {
    std::array<Hit, kBatch> hits;
    std::array<Vec3, kBatch> sides;
    std::array<float, kBatch> times{};
    std::array<int, kBatch> start_of;
    size_t count = 0;
    for (int k = 0; k < size; ++k) {
      const Emission& e = starts_[static_cast<size_t>(k)].emission;
      if (!(e.weight > 0) || e.kind != LightKind::triangle) continue;
      scene.locate(e, hits[count], sides[count]);
      times[count] = e.time;
      start_of[count++] = k;
    }
    scene.surfaces({sides.data(), count}, {hits.data(), count}, points_.data(), times.data());
    for (size_t n = 0; n < count; ++n) {
      Start& start = starts_[static_cast<size_t>(start_of[n])];
      start.point = &points_[n];
      start.emission.position = points_[n].position;
      const Vec3 out = points_[n].front ? points_[n].ng : -points_[n].ng;
      start.emission.direction = Frame(out).to_world(start.emission.direction);
    }
    for (int k = 0; k < size; ++k) compute_ray(scene, k);
  }

  // Emission and ray of a start.
  void compute_ray(const scene::CompiledScene& scene, int k) {
    Start& start = starts_[static_cast<size_t>(k)];
    const Emission& e = start.emission;
    start.emitted = e.weight > 0 ? Color(scene.emitted(e, start.point)) : Color(0);
    if constexpr (M::kScattering)
      if (e.density.infinite && scene.atmosphere_is_unbounded()) start.emitted = Color(0);
    Ray& ray = rays_[static_cast<size_t>(k)];
    ray = Ray();
    ray.origin = e.position;
    ray.direction = e.direction;
    if (start.point) start.point->spawn(e.direction, ray);
    if constexpr (M::kMedia)
      if (e.weight > 0 && e.kind != LightKind::medium)
        scene.find_media_at_light(e, start.point, ray.origin, start.media);
  }

  void launch_one(int k, PathWavefront& paths) {
    const Start& start = starts_[static_cast<size_t>(k)];
    const Emission& e = start.emission;
    const auto path = static_cast<size_t>(start.path);
    const float beam = start.point ? start.point->beam(e.direction) : 1;
    const Color flux = start.emitted * (e.weight * beam);
    const float most = max_component(flux);
    flux_[path] = most;
    lights_[path] = e.light;
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
