// What all methods that gather from the camera share: camera rays in packets, then one estimate per ray.
//
// Derived offers `template <class M> typename M::Color estimate(scene, ray, first hit, random, rays) const`, a
// `parameters()` tuple called `knobs()`, and a constexpr Description.
#pragma once
#include <array>

#include "base/hash.h"
#include "film/film.h"
#include "integrator/integrator.h"
#include "transport/walk.h"

namespace etendue::integrator {

struct Description {
  const char* name;
  const char* label;
  const char* doc;
  const char* paths;
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

  uint64_t sample(const Pass& pass, const PixelRun& run, std::span<Rgb> radiance) const final {
    return transport::with_model(*pass.model, [&]<class M>(M) { return sample_with<M>(pass, run, radiance); });
  }

 protected:
  bool at_limit(int length) const { return max_depth > 0 && length >= max_depth; }

 private:
  const Derived& self() const { return static_cast<const Derived&>(*this); }

  template <class M>
  uint64_t sample_with(const Pass& pass, const PixelRun& run, std::span<Rgb> radiance) const {
    std::array<Ray, Accel::kPacket> rays;
    std::array<Hit, Accel::kPacket> hits;
    std::array<uint32_t, Accel::kPacket> seeds;
    const auto n = static_cast<size_t>(run.count);
    const uint32_t replicate = run.sample % film::kReplicates, index = run.sample / film::kReplicates;
    const auto stream = [&](size_t i) {
      return PathSampler(*pass.sampler, pixel_seed(pass.seed, run.x + static_cast<int>(i), run.y, replicate), index);
    };
    for (size_t i = 0; i < n; ++i) {
      PathSampler random = stream(i);
      random.start_camera();
      const Vec2 offset = pass.filter->sample(random.get_2d(camera_dimension::kPixel));
      const Vec2 center(static_cast<float>(run.x) + static_cast<float>(i) + 0.5f, static_cast<float>(run.y) + 0.5f);
      rays[i] = pass.camera->ray(center + offset, random.get_2d(camera_dimension::kLens));
      seeds[i] = random.seed();
    }
    pass.scene->intersect({rays.data(), n}, {seeds.data(), n}, {hits.data(), n});
    uint64_t traced = n;
    for (size_t i = 0; i < n; ++i) {
      PathSampler random = stream(i);
      uint32_t more = 0;
      radiance[i] = self().template estimate<M>(*pass.scene, rays[i], hits[i], random, more);
      traced += more;
    }
    return traced;
  }
};

}  // namespace etendue::integrator
