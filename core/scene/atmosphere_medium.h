// The atmosphere of a scene in the form that rendering reads.
#pragma once
#include "geometry/ray.h"
#include "medium/medium.h"

namespace etendue::scene {

// A part of a ray, by parameters.
struct RayInterval {
  float from = 0, to = 0;
  bool empty() const { return !(from < to); }
};

struct AtmosphereMedium {
  HomogeneousMedium medium;
  Vec3 centre{0};
  float radius = kInfinity;  // metres

  // The part of an interval of the ray that lies inside the sphere.
  RayInterval inside(const Ray& ray, const RayInterval& interval) const;
  // The transmittance of this interval of the ray. Its direction may have any length.
  Rgb transmittance(const Ray& ray, const RayInterval& interval) const;
};

}  // namespace etendue::scene
