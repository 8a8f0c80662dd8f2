// Brings contributions of light paths to the pixels that they belong to.
#pragma once
#include <bit>

#include "integrator/integrator.h"
#include "transport/wavefront/connections.h"

namespace etendue::integrator {

// For one task. Contributions are those of one light path; `scale` makes a mean of them: one over the number of paths.
class Splatter {
 public:
  Splatter(const RenderContext& context, const TaskContext& task_context, float scale)
      : scene_(*context.scene),
        filter_(*context.filter, context.width, context.height),
        lists_(task_context.splats),
        scale_(scale) {}
  // A list for each path.
  Splatter(const RenderContext& context, std::span<film::Splats> lists)
      : scene_(*context.scene),
        filter_(*context.filter, context.width, context.height),
        lists_(lists.data()),
        apart_(true) {}

  // Whether a point of the picture belongs to any of its pixels.
  bool reaches(Vec2 raster) const { return filter_.reaches(raster); }

  // What is seen of the camera for sure. `seed` stands for a random choice among the pixels whose filters reach there.
  void add(int path, Vec2 raster, uint32_t seed, const Rgb& contribution) {
    deliver({raster, seed, static_cast<uint16_t>(path), contribution});
  }

  // Adds a contribution unless the ray is occluded at that time. The medium at its start attenuates it over `length`
  // metres.
  template <class Medium>
  void connect(int path, const Ray& ray, float time, uint32_t seed, const Medium& medium, float length, Vec2 raster,
               const Rgb& contribution) {
    Seen& seen = connections_.add(ray, time, seed, medium, length);
    seen.raster = raster, seen.seed = seed, seen.path = static_cast<uint16_t>(path);
    seen.contribution = contribution;
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
    uint16_t path;
    Rgb contribution;
  };

  film::Splats& list(int path) { return lists_[apart_ ? path : 0]; }
  void deliver(const Seen& seen) {
    // Chains ask with the same seed again and again.
    const uint32_t first = mix_bits(seen.seed ^ mix_bits(std::bit_cast<uint32_t>(seen.raster.x)));
    const auto to = filter_.choose(seen.raster, {to_unit_float(first), to_unit_float(mix_bits(first))});
    if (to) list(seen.path).push_back({to->pixel, seen.contribution * (to->weight * scale_)});
  }
  void settle() {
    rays_ += connections_.settle(scene_, [this](Seen& seen, const Rgb& transmittance) {
      seen.contribution *= transmittance;
      deliver(seen);
    });
  }

  const scene::CompiledScene& scene_;
  film::SplatFilter filter_;
  film::Splats* lists_;
  bool apart_ = false;
  float scale_ = 1;
  uint64_t rays_ = 0;
  transport::Connections<Seen> connections_;
};

}  // namespace etendue::integrator
