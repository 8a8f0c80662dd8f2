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

  // Whether a point of the picture belongs to any of its pixels.
  bool reaches(Vec2 raster) const { return filter_.reaches(raster); }

  // What is seen of the camera for sure. `seed` stands for a random choice among the pixels whose filters reach there.
  void add(Vec2 raster, uint32_t seed, const Rgb& contribution) { deliver({raster, seed, contribution}); }

  // What counts unless something lies along the ray at that time.
  void connect(const Ray& ray, float time, uint32_t seed, Vec2 raster, const Rgb& contribution) {
    connections_.add(ray, time, seed, {raster, seed, contribution});
    if (connections_.full()) settle();
  }

  // To be called at the end; returns the number of rays traced.
  uint64_t finish() {
    settle();
    return rays_;
  }

 private:
  struct Seen {
    Vec2 raster;
    uint32_t seed;
    Rgb contribution;
  };

  void deliver(const Seen& seen) {
    const uint32_t first = mix_bits(seen.seed), second = mix_bits(first);
    const auto to = filter_.choose(seen.raster, {to_unit_float(first), to_unit_float(second)});
    if (to) splats_.push_back({to->pixel, seen.contribution * (to->weight * scale_)});
  }
  void settle() {
    rays_ += connections_.settle(scene_, [this](const Seen& seen) { deliver(seen); });
  }

  const scene::CompiledScene& scene_;
  film::SplatFilter filter_;
  film::Splats& splats_;
  float scale_;
  uint64_t rays_ = 0;
  transport::Connections<Seen> connections_;
};

}  // namespace etendue::integrator
