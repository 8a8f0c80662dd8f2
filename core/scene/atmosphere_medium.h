// The atmosphere of a scene in the form that rendering reads.
#pragma once
#include "geometry/ray.h"
#include "medium/heterogeneous_medium.h"

namespace etendue::scene {

// A part of a ray, by parameters.
struct RayInterval {
  float from = 0, to = 0;
  bool empty() const { return !(from < to); }
};

struct AtmosphereMedium {
  HomogeneousMedium medium;
  std::shared_ptr<const HeterogeneousMedium> heterogeneous = nullptr;  // takes the place of `medium` if not null
  std::string error = {};  // why the density cannot be rendered; empty if it can
  Vec3 centre{0};
  float radius = kInfinity;  // metres

  // The part of an interval of the ray that lies inside the sphere.
  RayInterval inside(const Ray& ray, const RayInterval& interval) const;
  // The length of that part in metres. The direction of the ray may have any length.
  float length_inside(const Ray& ray, const RayInterval& interval) const;
};

}  // namespace etendue::scene
