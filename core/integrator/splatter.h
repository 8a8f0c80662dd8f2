// Brings contributions of light paths to the pixels that they belong to.
#pragma once
#include "integrator/integrator.h"
#include "transport/connections.h"

namespace etendue::integrator {

// For one task. Contributions are those of one light path; `scale` makes a mean of them: one over the number of paths.
class Splatter {
 public:
  Splatter(const Pass& pass, const Turn& turn, float scale)
      : scene_(*pass.scene), filter_(*pass.filter, pass.width, pass.height), splats_(*turn.splats), scale_(scale) {}

  // Where a point of the picture falls; nothing if it is outside. `seed` stands for a random choice among the pixels
  // whose filters reach there.
  std::optional<film::SplatFilter::Choice> pixel(Vec2 raster, uint32_t seed) const {
    const uint32_t more = mix_bits(seed);
    return filter_.choose(raster, {to_unit_float(more), to_unit_float(mix_bits(more))});
  }

  // What is seen of the camera for sure.
  void add(const film::SplatFilter::Choice& to, const Rgb& contribution) {
    splats_.push_back({to.pixel, contribution * (to.weight * scale_)});
  }

  // What counts unless something lies along the ray at that time.
  void connect(const Ray& ray, float time, uint32_t seed, const film::SplatFilter::Choice& to,
               const Rgb& contribution) {
    connections_.add(ray, time, seed, {to.pixel, contribution * (to.weight * scale_)});
    if (connections_.full()) settle();
  }

  // To be called at the end; returns the number of rays traced.
  uint64_t finish() {
    settle();
    return rays_;
  }

 private:
  void settle() {
    rays_ += connections_.settle(scene_, [this](const film::Splat& splat) { splats_.push_back(splat); });
  }

  const scene::CompiledScene& scene_;
  film::SplatFilter filter_;
  film::Splats& splats_;
  float scale_;
  uint64_t rays_ = 0;
  transport::Connections<film::Splat> connections_;
};

}  // namespace etendue::integrator
