// A sphere around the scene, from which light from infinity enters.
#pragma once
#include "base/frame.h"
#include "base/warp.h"

namespace etendue {

struct SceneSphere {
  Vec3 centre{0};
  float radius = 1;  // m

  // A point outside the scene from which a ray in this direction starts: uniform over a disk across the ray, of the
  // sphere's radius.
  Vec3 entry_point(const Vec3& direction, Vec2 u) const {
    const Vec2 across = square_to_disk(u) * radius;
    const Frame frame(direction);
    return centre + frame.x * across.x + frame.y * across.y - direction * radius;
  }
  // The density of `entry_point` on that disk, 1/m^2.
  float entry_pdf() const { return 1 / (kPi * sqr(radius)); }
};

}  // namespace etendue
