// Walks that start at the camera: one for each pixel of a block.
#pragma once
#include <array>
#include <memory>

#include "base/hash.h"
#include "film/film.h"
#include "integrator/integrator.h"
#include "integrator/shared/pixel_order.h"
#include "transport/path_expression/path_expression.h"
#include "transport/wavefront/path_wavefront.h"

namespace etendue::integrator {

// The seed of a pixel's random numbers in one half of the film.
inline uint32_t pixel_seed(uint64_t seed, int x, int y, uint32_t replicate) {
  uint64_t h = mix_bits(seed * film::kReplicates + replicate + 1);
  h = mix_bits(h ^ (static_cast<uint64_t>(static_cast<uint32_t>(y)) << 32 | static_cast<uint32_t>(x)));
  return static_cast<uint32_t>(h >> 32);
}

inline bool is_wanted(const Turn& turn) { return !turn.wanted || (*turn.wanted)(); }

// One for each thread and model: it is too large to be made anew for every block.
template <class M>
transport::Front<M>& front_of_thread() {
  static thread_local const auto front = std::make_unique<transport::Front<M>>();
  return *front;
}

// Lets a walk go from every pixel of the block, in the given order; on return nothing has been traced yet. The walks
// have times of their own in a model with motion, or these.
template <class M>
void launch_camera_walks(const Pass& pass, const PixelBlock& block, const BlockOrder& order, const Turn& turn,
                         transport::Front<M>& front, const float* given_times = nullptr) {
  const uint32_t replicate = block.sample % film::kReplicates;
  front.begin(*pass.scene, *pass.sampler, block.sample / film::kReplicates, turn.wanted, pass.model->moving);
  front.expect_coherence();
  if constexpr (M::kClasses) front.admit(pass.model->paths->automaton());
  for (int i = 0; i < order.size(); ++i)
    front.add(pixel_seed(pass.seed, block.x + order.x(i), block.y + order.y(i), replicate));
  std::array<float, transport::Front<M>::kCapacity> together;
  if (pass.moment) together.fill(*pass.moment), given_times = together.data();
  const bool draws_time = pass.draws_times() && !given_times;
  SampleTable& random = front.draw_start(dimensions(camera_dimension::kPixel, 2) |
                                         (pass.camera->has_lens() ? dimensions(camera_dimension::kLens, 2) : 0) |
                                         (draws_time ? dimensions(camera_dimension::kTime, 1) : 0));
  auto &x = random.values[camera_dimension::kPixel], &y = random.values[camera_dimension::kPixel + 1];
  const auto &lens_u = random.values[camera_dimension::kLens], &lens_v = random.values[camera_dimension::kLens + 1];
  const float* times = draws_time ? random.values[camera_dimension::kTime].data() : given_times;
  const auto count = static_cast<size_t>(order.size());
  pass.filter->sample_all(x.data(), count), pass.filter->sample_all(y.data(), count);
  for (int i = 0; i < order.size(); ++i) {
    const auto path = static_cast<size_t>(i);
    x[path] += static_cast<float>(block.x + order.x(i)) + 0.5f;
    y[path] += static_cast<float>(block.y + order.y(i)) + 0.5f;
  }
  std::array<Ray, transport::Front<M>::kCapacity> rays;
  pass.camera->rays({x.data(), y.data()}, {lens_u.data(), lens_v.data()}, times, count, rays.data());
  for (int i = 0; i < order.size(); ++i) {
    const auto path = static_cast<size_t>(i);
    front.launch(i, rays[path], pass.model->moving ? times[i] : 0);
  }
}

// What the walks found, pixel by pixel of the block; the number of rays, or nothing if the walks were given up.
template <class M>
std::optional<uint64_t> collect(transport::Front<M>& front, const BlockOrder& order, std::span<Rgb> radiance) {
  if (front.given_up()) return {};
  for (int i = 0; i < front.size(); ++i) radiance[order.index(i)] = front.state(i).radiance;
  return front.rays_traced();
}

}  // namespace etendue::integrator
