// What all methods that gather from the camera share: a front of camera rays to start with, and a pixel for each path.
//
// Derived offers `template <class M> void estimate(transport::Front<M>&) const`, which lets the walks go and adds what
// they find to their radiance, a `parameters()` tuple called `knobs()`, and a constexpr Description.
#pragma once
#include <array>

#include "base/hash.h"
#include "film/film.h"
#include "integrator/block_order.h"
#include "integrator/integrator.h"
#include "transport/gather.h"

namespace etendue::integrator {

struct Description {
  const char* name;
  const char* label;
  const char* doc;
  const char* paths;
  const char* point_paths;
  Bias bias;
  const char* cost;
  const char* fails;
};

// The seed of a pixel's random numbers in one half of the film.
inline uint32_t pixel_seed(uint64_t seed, int x, int y, uint32_t replicate) {
  uint64_t h = mix_bits(seed * film::kReplicates + replicate + 1);
  h = mix_bits(h ^ (static_cast<uint64_t>(static_cast<uint32_t>(y)) << 32 | static_cast<uint32_t>(x)));
  return static_cast<uint32_t>(h >> 32);
}

template <class Derived>
class Gathering : public Integrator {
 public:
  Number<int> max_depth{
      "max-depth",
      "Longest path",
      0,
      {0, 1000},
      "Path segments from camera to light: 1 is a light seen directly, 2 direct illumination, 0 no limit"};

  std::vector<ParameterInfo> parameters() const final { return describe_all(const_cast<Derived&>(self()).knobs()); }
  bool set(std::string_view name, const Value& value) final {
    return assign_by_name(static_cast<Derived&>(*this).knobs(), name, value);
  }

  std::optional<uint64_t> sample(const Pass& pass, const PixelBlock& block, std::span<Rgb> radiance) const final {
    return transport::with_model(*pass.model, [&]<class M>(M) { return sample_with<M>(pass, block, radiance); });
  }

 protected:
  bool at_limit(int length) const { return max_depth > 0 && length >= max_depth; }

 private:
  const Derived& self() const { return static_cast<const Derived&>(*this); }

  template <class M>
  std::optional<uint64_t> sample_with(const Pass& pass, const PixelBlock& block, std::span<Rgb> radiance) const {
    // One for each thread and model: it is too large to be made anew for every block.
    static thread_local const auto front = std::make_unique<transport::Front<M>>();
    const BlockOrder order(block);
    launch(pass, block, order, *front);
    self().template estimate<M>(*front);
    if (front->given_up()) return {};
    for (int i = 0; i < front->size(); ++i) radiance[order.index(i)] = front->state(i).radiance;
    return front->rays_traced();
  }

  template <class M>
  static void launch(const Pass& pass, const PixelBlock& block, const BlockOrder& order, transport::Front<M>& front) {
    const uint32_t replicate = block.sample % film::kReplicates;
    front.begin(*pass.scene, *pass.sampler, block.sample / film::kReplicates, pass.wanted, pass.model->moving);
    if constexpr (M::kClasses) front.admit(pass.model->paths->automaton());
    for (int i = 0; i < order.size(); ++i)
      front.add(pixel_seed(pass.seed, block.x + order.x(i), block.y + order.y(i), replicate));
    SampleTable& random = front.draw_camera(dimensions(camera_dimension::kPixel, 2) |
                                            (pass.camera->has_lens() ? dimensions(camera_dimension::kLens, 2) : 0) |
                                            (pass.model->moving ? dimensions(camera_dimension::kTime, 1) : 0));
    auto &x = random.values[camera_dimension::kPixel], &y = random.values[camera_dimension::kPixel + 1];
    const auto &lens_u = random.values[camera_dimension::kLens], &lens_v = random.values[camera_dimension::kLens + 1];
    const auto& times = random.values[camera_dimension::kTime];
    const auto count = static_cast<size_t>(order.size());
    pass.filter->sample_all(x.data(), count), pass.filter->sample_all(y.data(), count);
    for (int i = 0; i < order.size(); ++i) {
      const auto path = static_cast<size_t>(i);
      x[path] += static_cast<float>(block.x + order.x(i)) + 0.5f;
      y[path] += static_cast<float>(block.y + order.y(i)) + 0.5f;
    }
    std::array<Ray, transport::Front<M>::kCapacity> rays;
    pass.camera->rays({x.data(), y.data()}, {lens_u.data(), lens_v.data()}, times.data(), count, rays.data());
    for (int i = 0; i < order.size(); ++i) {
      const auto path = static_cast<size_t>(i);
      front.launch(i, rays[path], pass.model->moving ? times[path] : 0);
    }
  }
};

}  // namespace etendue::integrator
