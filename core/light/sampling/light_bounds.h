// Bounds of the position, the directions and the intensity of lights, for the light tree.
//                                                    [Conty Estevez and Kulla 2018; Pharr et al. 2023, sec. 12.6.3]
#pragma once
#include "geometry/motion.h"

namespace etendue {

// Of one light or of several.
struct LightBounds {
  Bounds box;
  Vec3 axis{0, 0, 1};
  float normals = kPi;       // the largest angle between the axis and a normal, radians
  float emission = kPi / 2;  // the largest angle between a normal and an emitted direction, radians
  bool two_sided = false;    // the same holds about the opposite axis
  float intensity = 0;       // the sum of the largest intensities, cd
  float range = kInfinity;   // nothing arrives at larger distances, m

  // Unites the bounds of two sets of lights.
  void extend(const LightBounds& other);
};

// The union of the bounds `at(time)` over the shutter interval. A motion on straight lines stays within the box of its
// ends; directions may rotate in between, so that different axes leave all directions open.
template <class At>
LightBounds bounds_over_time(const Motion& motion, At&& at) {
  LightBounds all = at(0.0f);
  const auto intervals = static_cast<float>(motion.steps() - 1);
  for (size_t k = 1; k < motion.steps(); ++k) {
    const LightBounds b = at(static_cast<float>(k) / intervals);
    if (b.axis != all.axis) all.normals = kPi;
    all.box.extend(b.box);
    all.intensity = std::max(all.intensity, b.intensity);
  }
  return all;
}

}  // namespace etendue
