// Paths whose random numbers are given, and whose first two say where in the picture they end: what Markov chains in
// primary sample space look at.
#pragma once
#include "integrator/bdpt/techniques.h"
#include "integrator/shared/camera_paths.h"

namespace etendue::integrator {

struct PrimarySamplePaths {
  const Sampler *camera, *light;            // the numbers of the walks from either end
  std::span<const uint32_t> seeds;          // of each path, for both
  std::span<const Technique> techniques{};  // that each is to be found by; empty: all
  uint32_t light_salt = 0x68e31da4U;        // tells the worlds of both ends apart
};

// The part of the plane whose points may belong to pixels.
struct Plane {
  Vec2 corner, extent;

  Plane(const RenderContext& context)  // NOLINT(google-explicit-constructor)
      : corner(-context.filter->radius()),
        extent(Vec2(static_cast<float>(context.width), static_cast<float>(context.height)) - 2.0f * corner) {}
  float area() const { return extent.x * extent.y; }
};

// Lets a walk go for each path that goes(i) says; rasters[i] is where it passes through the picture. On return nothing
// has been traced yet. The walks have times of their own in a model with motion, or these.
template <class M, class Goes>
void launch_primary_sample_paths(const RenderContext& context, const PrimarySamplePaths& given,
                                 const TaskContext& task_context, transport::PathWavefront<M>& paths,
                                 std::span<Vec2> rasters, Goes&& goes, const float* given_times = nullptr) {
  paths.begin(*context.scene, *given.camera, 0, task_context.keep_going, context.model->moving);
  if constexpr (M::kClasses) paths.filter_paths(context.model->paths->automaton());
  for (const uint32_t seed : given.seeds) paths.add(seed);
  const bool draws_time = context.model->moving && !given_times;
  SampleTable& random = paths.draw_start(dimensions(camera_dimension::kPixel, 2) |
                                         (context.camera->has_lens() ? dimensions(camera_dimension::kLens, 2) : 0) |
                                         (draws_time ? dimensions(camera_dimension::kTime, 1) : 0));
  const Plane plane(context);
  auto &x = random.values[camera_dimension::kPixel], &y = random.values[camera_dimension::kPixel + 1];
  const auto &lens_u = random.values[camera_dimension::kLens], &lens_v = random.values[camera_dimension::kLens + 1];
  const float* times = draws_time ? random.values[camera_dimension::kTime].data() : given_times;
  const size_t count = given.seeds.size();
  for (size_t i = 0; i < count; ++i) {
    rasters[i] = plane.corner + plane.extent * Vec2(x[i], y[i]);
    x[i] = rasters[i].x, y[i] = rasters[i].y;
  }
  std::array<Ray, transport::PathWavefront<M>::kCapacity> rays;
  context.camera->rays({x.data(), y.data()}, {lens_u.data(), lens_v.data()}, times, count, rays.data());
  for (size_t i = 0; i < count; ++i) {
    if (!goes(static_cast<int>(i))) continue;
    const float time = context.model->moving ? times[i] : 0;
    paths.launch(static_cast<int>(i), rays[i], medium_at_camera<M>(context, rays[i], time), time);
  }
}

}  // namespace etendue::integrator
