// Paths from the camera: one for each pixel of a block.
#pragma once
#include <array>
#include <memory>

#include "integrator/integrator.h"
#include "integrator/shared/pixel_order.h"
#include "integrator/shared/pixel_seeds.h"
#include "transport/path_expression/path_expression.h"
#include "transport/wavefront/path_wavefront.h"

namespace etendue::integrator {

inline bool should_continue(const TaskContext& task_context) {
  return !task_context.keep_going || (*task_context.keep_going)();
}

// The wavefront of this thread and model, reused because it is large.
template <class M>
transport::PathWavefront<M>& thread_wavefront() {
  static thread_local const auto paths = std::make_unique<transport::PathWavefront<M>>();
  return *paths;
}

// The solids that contain the start of a camera ray.
template <class M>
transport::MediumState<M> medium_at_camera(const RenderContext& context, const Ray& ray, float time) {
  if constexpr (M::kMedia)
    return context.scene->media_at_camera(ray, time);
  else
    return {};
}

// Launches a path from every pixel of the block, in the given order; no ray has been traced on return. In a scene with
// motion, `given_times` are the times of the paths; null: sampled.
template <class M>
void launch_camera_paths(const RenderContext& context, const PixelBlock& block, const PixelOrder& order,
                         const TaskContext& task_context, transport::PathWavefront<M>& paths,
                         const float* given_times = nullptr) {
  const uint32_t half_buffer = block.sample % film::kHalfBuffers;
  paths.begin(*context.scene, *context.sampler, block.sample / film::kHalfBuffers, task_context.keep_going,
              context.model->moving);
  paths.assume_coherent();
  paths.record(task_context.recorder);
  if constexpr (M::kClasses) paths.filter_paths(context.model->paths->automaton());
  const PixelSeeds seed_of(*context.sampler, context.seed, half_buffer);
  for (int i = 0; i < order.size(); ++i) paths.add(seed_of(block.x + order.x(i), block.y + order.y(i)));
  std::array<float, transport::PathWavefront<M>::kCapacity> common_times;
  if (context.shared_time) {
    common_times.fill(*context.shared_time);
    given_times = common_times.data();
  }
  const bool draws_time = context.samples_time() && !given_times;
  SampleTable& random = paths.draw_start(dimensions(camera_dimension::kPixel, 2) |
                                         (context.camera->has_lens() ? dimensions(camera_dimension::kLens, 2) : 0) |
                                         (draws_time ? dimensions(camera_dimension::kTime, 1) : 0) |
                                         (M::kSpectral ? dimensions(camera_dimension::kWavelength, 1) : 0));
  if constexpr (M::kSpectral)
    for (int i = 0; i < order.size(); ++i)
      paths.color().start(i, random.values[camera_dimension::kWavelength][static_cast<size_t>(i)]);
  auto &x = random.values[camera_dimension::kPixel], &y = random.values[camera_dimension::kPixel + 1];
  const auto &lens_u = random.values[camera_dimension::kLens], &lens_v = random.values[camera_dimension::kLens + 1];
  const float* times = draws_time ? random.values[camera_dimension::kTime].data() : given_times;
  const auto count = static_cast<size_t>(order.size());
  context.filter->sample_all(x.data(), count);
  context.filter->sample_all(y.data(), count);
  for (int i = 0; i < order.size(); ++i) {
    const auto path = static_cast<size_t>(i);
    x[path] += static_cast<float>(block.x + order.x(i)) + 0.5f;
    y[path] += static_cast<float>(block.y + order.y(i)) + 0.5f;
  }
  std::array<Ray, transport::PathWavefront<M>::kCapacity> rays;
  context.camera->rays({x.data(), y.data()}, {lens_u.data(), lens_v.data()}, times, count, rays.data());
  for (int i = 0; i < order.size(); ++i) {
    const auto path = static_cast<size_t>(i);
    const float time = context.model->moving ? times[i] : 0;
    paths.launch(i, rays[path], medium_at_camera<M>(context, rays[path], time), time);
  }
  if (!task_context.recorder) return;
  const Vec2i pixel = task_context.recorder->pixel();
  for (int i = 0; i < order.size(); ++i) {
    if (block.x + order.x(i) != pixel.x || block.y + order.y(i) != pixel.y) continue;
    const auto path = static_cast<size_t>(i);
    std::optional<Vec2> lens;
    if (context.camera->has_lens()) lens = Vec2(lens_u[path], lens_v[path]);
    task_context.recorder->start(i, Vec2(x[path], y[path]), lens, paths.state(i).time, rays[path]);
  }
}

// Appends the radiance of spectral paths at their wavelengths, in the order of the paths.
template <class M>
void append_spectra([[maybe_unused]] transport::PathWavefront<M>& paths,
                    [[maybe_unused]] std::vector<SpectralSample>& spectra) {
  if constexpr (M::kSpectral)
    for (int i = 0; i < paths.size(); ++i) spectra.push_back({paths.state(i).radiance, paths.color().wavelengths(i)});
}

// Copies the radiance of the paths to the pixels of the block. Returns the number of rays traced, or nothing if the
// paths were cancelled.
template <class M>
std::optional<uint64_t> collect(transport::PathWavefront<M>& paths, const PixelOrder& order, std::span<Rgb> radiance) {
  if (paths.cancelled()) return {};
  for (int i = 0; i < paths.size(); ++i) radiance[order.index(i)] = paths.color().to_rgb(i, paths.state(i).radiance);
  return paths.rays_traced();
}

}  // namespace etendue::integrator
