// Paths with given random numbers: points of primary sample space, for Markov chains. The first two numbers are the
// position on the image plane.
#pragma once
#include "integrator/bdpt/techniques.h"
#include "integrator/shared/camera_paths.h"

namespace etendue::integrator {

struct PrimarySamplePaths {
  const Sampler *camera, *light;            // random numbers of the camera and light subpaths
  std::span<const uint32_t> seeds;          // of each path, for both subpaths
  std::span<const Technique> techniques{};  // the only techniques of each path; empty: all
  uint32_t light_salt = 0x68e31da4U;        // makes opacity decisions of the two subpaths independent
};

// The part of the image plane within the filter radius of a pixel.
struct ImagePlane {
  Vec2 corner, extent;

  ImagePlane(const RenderContext& context)  // NOLINT(google-explicit-constructor)
      : corner(-context.filter->radius()),
        extent(Vec2(static_cast<float>(context.width), static_cast<float>(context.height)) - 2.0f * corner) {}
  float area() const { return extent.x * extent.y; }
};

// Launches the camera path of each point for which is_active(i) holds; rasters[i] is its position on the image plane.
// No ray has been traced on return. In a scene with motion, `given_times` are the times of the paths; null: sampled.
template <class M, class IsActive>
void launch_primary_sample_paths(const RenderContext& context, const PrimarySamplePaths& primary,
                                 const TaskContext& task_context, transport::PathWavefront<M>& paths,
                                 std::span<Vec2> rasters, IsActive&& is_active, const float* given_times = nullptr) {
  paths.begin(*context.scene, *primary.camera, 0, task_context.keep_going, context.model->moving);
  if constexpr (M::kClasses) paths.filter_paths(context.model->paths->automaton());
  for (const uint32_t seed : primary.seeds) paths.add(seed);
  const bool draws_time = context.model->moving && !given_times;
  SampleTable& random = paths.draw_start(dimensions(camera_dimension::kPixel, 2) |
                                         (context.camera->has_lens() ? dimensions(camera_dimension::kLens, 2) : 0) |
                                         (draws_time ? dimensions(camera_dimension::kTime, 1) : 0));
  const ImagePlane plane(context);
  auto &x = random.values[camera_dimension::kPixel], &y = random.values[camera_dimension::kPixel + 1];
  const auto &lens_u = random.values[camera_dimension::kLens], &lens_v = random.values[camera_dimension::kLens + 1];
  const float* times = draws_time ? random.values[camera_dimension::kTime].data() : given_times;
  const size_t count = primary.seeds.size();
  for (size_t i = 0; i < count; ++i) {
    rasters[i] = plane.corner + plane.extent * Vec2(x[i], y[i]);
    x[i] = rasters[i].x;
    y[i] = rasters[i].y;
  }
  std::array<Ray, transport::PathWavefront<M>::kCapacity> rays;
  context.camera->rays({x.data(), y.data()}, {lens_u.data(), lens_v.data()}, times, count, rays.data());
  for (size_t i = 0; i < count; ++i) {
    if (!is_active(static_cast<int>(i))) continue;
    const float time = context.model->moving ? times[i] : 0;
    paths.launch(static_cast<int>(i), rays[i], medium_at_camera<M>(context, rays[i], time), time);
  }
}

}  // namespace etendue::integrator
