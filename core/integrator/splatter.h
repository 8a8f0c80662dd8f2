// Brings contributions of light paths to the pixels that they belong to.
#pragma once
#include <bit>

#include "integrator/integrator.h"
#include "transport/connections.h"

namespace etendue::integrator {

// For one task. Contributions are those of one light path; `scale` makes a mean of them: one over the number of paths.
class Splatter {
 public:
  Splatter(const Pass& pass, const Turn& turn, float scale)
      : scene_(*pass.scene), filter_(*pass.filter, pass.width, pass.height), lists_(turn.splats), scale_(scale) {}
  // A list for each path.
  Splatter(const Pass& pass, std::span<film::Splats> lists)
      : scene_(*pass.scene), filter_(*pass.filter, pass.width, pass.height), lists_(lists.data()), apart_(true) {}

  // Where a point of the picture falls; nothing if it is outside. `seed` stands for a random choice among the pixels
  // whose filters reach there.
  std::optional<film::SplatFilter::Choice> pixel(Vec2 raster, uint32_t seed) const {
    // Chains ask with the same seed again and again.
    const uint32_t more = mix_bits(seed ^ mix_bits(std::bit_cast<uint32_t>(raster.x)));
    return filter_.choose(raster, {to_unit_float(more), to_unit_float(mix_bits(more))});
  }

  // What is seen of the camera for sure.
  void add(int path, const film::SplatFilter::Choice& to, const Rgb& contribution) {
    list(path).push_back({to.pixel, contribution * (to.weight * scale_)});
  }

  // What counts unless something lies along the ray.
  void connect(int path, const Ray& ray, uint32_t seed, const film::SplatFilter::Choice& to, const Rgb& contribution) {
    connections_.add(ray, seed, {{to.pixel, contribution * (to.weight * scale_)}, static_cast<uint16_t>(path)});
    if (connections_.full()) settle();
  }

  // To be called at the end; returns the number of rays traced.
  uint64_t finish() {
    settle();
    return rays_;
  }

 private:
  struct Connected {
    film::Splat splat;
    uint16_t path;
  };

  film::Splats& list(int path) { return lists_[apart_ ? path : 0]; }
  void settle() {
    rays_ += connections_.settle(scene_, [this](const Connected& c) { list(c.path).push_back(c.splat); });
  }

  const scene::CompiledScene& scene_;
  film::SplatFilter filter_;
  film::Splats* lists_;
  bool apart_ = false;
  float scale_ = 1;
  uint64_t rays_ = 0;
  transport::Connections<Connected> connections_;
};

}  // namespace etendue::integrator
