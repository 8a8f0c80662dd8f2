// Paths whose random numbers are given, and whose first two say where in the picture they end: what Markov chains in
// primary sample space look at.
#pragma once
#include "integrator/bdpt/techniques.h"
#include "integrator/shared/camera_paths.h"

namespace etendue::integrator {

struct GivenPaths {
  const Sampler *camera, *light;            // the numbers of the walks from either end
  std::span<const uint32_t> seeds;          // of each path, for both
  std::span<const Technique> techniques{};  // that each is to be found by; empty: all
  uint32_t light_salt = 0x68e31da4U;        // tells the worlds of both ends apart
};

// The part of the plane whose points may belong to pixels.
struct Plane {
  Vec2 corner, extent;

  Plane(const Pass& pass)  // NOLINT(google-explicit-constructor)
      : corner(-pass.filter->radius()),
        extent(Vec2(static_cast<float>(pass.width), static_cast<float>(pass.height)) - 2.0f * corner) {}
  float area() const { return extent.x * extent.y; }
};

// Lets a walk go for each path that goes(i) says; rasters[i] is where it passes through the picture. On return nothing
// has been traced yet. The walks have times of their own in a model with motion, or these.
template <class M, class Goes>
void launch_given_walks(const Pass& pass, const GivenPaths& given, const Turn& turn, transport::Front<M>& front,
                        std::span<Vec2> rasters, Goes&& goes, const float* given_times = nullptr) {
  front.begin(*pass.scene, *given.camera, 0, turn.wanted, pass.model->moving);
  if constexpr (M::kClasses) front.admit(pass.model->paths->automaton());
  for (const uint32_t seed : given.seeds) front.add(seed);
  const bool draws_time = pass.model->moving && !given_times;
  SampleTable& random = front.draw_start(dimensions(camera_dimension::kPixel, 2) |
                                         (pass.camera->has_lens() ? dimensions(camera_dimension::kLens, 2) : 0) |
                                         (draws_time ? dimensions(camera_dimension::kTime, 1) : 0));
  const Plane plane(pass);
  auto &x = random.values[camera_dimension::kPixel], &y = random.values[camera_dimension::kPixel + 1];
  const auto &lens_u = random.values[camera_dimension::kLens], &lens_v = random.values[camera_dimension::kLens + 1];
  const float* times = draws_time ? random.values[camera_dimension::kTime].data() : given_times;
  const size_t count = given.seeds.size();
  for (size_t i = 0; i < count; ++i) {
    rasters[i] = plane.corner + plane.extent * Vec2(x[i], y[i]);
    x[i] = rasters[i].x, y[i] = rasters[i].y;
  }
  std::array<Ray, transport::Front<M>::kCapacity> rays;
  pass.camera->rays({x.data(), y.data()}, {lens_u.data(), lens_v.data()}, times, count, rays.data());
  for (size_t i = 0; i < count; ++i)
    if (goes(static_cast<int>(i))) front.launch(static_cast<int>(i), rays[i], pass.model->moving ? times[i] : 0);
}

}  // namespace etendue::integrator
