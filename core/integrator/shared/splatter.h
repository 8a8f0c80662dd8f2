// Adds the contributions of light paths to the image.
#pragma once
#include <bit>

#include "integrator/integrator.h"
#include "transport/wavefront/connections.h"

namespace etendue::integrator {

// Used by one task. Contributions are those of one light path; `scale` turns their sum into a mean: one over the number
// of paths.
class Splatter {
 public:
  Splatter(const RenderContext& context, const TaskContext& task_context, float scale)
      : scene_(*context.scene),
        filter_(*context.filter, context.width, context.height),
        lists_(task_context.splats),
        scale_(scale) {}
  // Collects the splats of each path in a list of its own.
  Splatter(const RenderContext& context, std::span<film::Splats> lists)
      : scene_(*context.scene),
        filter_(*context.filter, context.width, context.height),
        lists_(lists.data()),
        per_path_(true) {}

  // Whether a point of the image plane contributes to any pixel.
  bool reaches(Vec2 raster) const { return filter_.reaches(raster); }

  // Adds an unoccluded contribution. `seed` selects the pixel at random among those whose filters cover the point.
  void add(int path, Vec2 raster, uint32_t seed, const Rgb& value) {
    add_to_pixel({raster, seed, static_cast<uint16_t>(path), value});
  }

  // Adds a contribution unless the ray is occluded at that time. The medium at its start attenuates it over `length`
  // metres. `value` contains the factor of the weight (ConnectionWeight) or all of it.
  template <class Medium, class Weight>
  void connect(int path, const Ray& ray, float time, uint32_t seed, const Medium& medium, float length, Vec2 raster,
               const Rgb& value, const Weight& weight) {
    Contribution& contribution = connections_.add(ray, time, seed, medium, length, weight);
    contribution.raster = raster;
    contribution.seed = seed;
    contribution.path = static_cast<uint16_t>(path);
    contribution.value = value;
    if (connections_.full()) trace_connections();
  }

  // Traces the remaining rays; returns the number of rays traced. To be called at the end.
  uint64_t finish() {
    trace_connections();
    return rays_;
  }

 private:
  struct Contribution {
    Vec2 raster;
    uint32_t seed;
    uint16_t path;
    Rgb value;
  };

  film::Splats& list_of(int path) { return lists_[per_path_ ? path : 0]; }
  void add_to_pixel(const Contribution& contribution) {
    // The position is hashed as well, because mutations of Markov chains repeat the same seed.
    const uint32_t first = mix_bits(contribution.seed ^ mix_bits(std::bit_cast<uint32_t>(contribution.raster.x)));
    const auto to = filter_.choose(contribution.raster, {to_unit_float(first), to_unit_float(mix_bits(first))});
    if (to) list_of(contribution.path).push_back({to->pixel, contribution.value * (to->weight * scale_)});
  }
  void trace_connections() {
    rays_ += connections_.settle(scene_, [this](Contribution& contribution, const Rgb& transmittance) {
      contribution.value *= transmittance;
      add_to_pixel(contribution);
    });
  }

  const scene::CompiledScene& scene_;
  film::SplatFilter filter_;
  film::Splats* lists_;
  bool per_path_ = false;
  float scale_ = 1;
  uint64_t rays_ = 0;
  transport::Connections<Contribution> connections_;
};

}  // namespace etendue::integrator
