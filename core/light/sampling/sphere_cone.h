// The cone of directions that a sphere subtends, from outside.         [Shirley et al. 1996; Pharr et al. 2023,
// sec. 6.2.4]
#pragma once
#include "base/frame.h"

namespace etendue {

struct SphereCone {
  float sin2, one_minus_cos;  // of the half angle

  // Squares of the sphere's radius and of the distance to its centre.
  SphereCone(float radius2, float distance2) : sin2(radius2 / distance2) {
    // For small angles 1 - cos loses all digits; a series does not.
    one_minus_cos = sin2 < 1e-3f ? 0.5f * sin2 * (1 + 0.25f * sin2) : 1 - safe_sqrt(1 - sin2);
  }

  // Uniform over the cone, per solid angle.
  float pdf() const { return 1 / (2 * kPi * one_minus_cos); }

  // The normal of the sphere where a uniform direction of the cone meets it. `to_receiver` is the unit direction from
  // the centre to the receiver.
  Vec3 sample_normal(const Vec3& to_receiver, Vec2 u) const {
    const float one_minus_cos_axis = u.x * one_minus_cos;  // of the direction and the axis of the cone
    const float sin2_axis = one_minus_cos_axis * (2 - one_minus_cos_axis);
    const float share = std::min(sin2_axis / sin2, 1.0f);
    // The angle between axis and normal, from the triangle of receiver, centre and point (law of sines).
    const float cosine = sin2_axis / std::sqrt(sin2) + (1 - one_minus_cos_axis) * safe_sqrt(1 - share);
    const float sine = safe_sqrt(1 - sqr(cosine));
    const float phi = 2 * kPi * u.y;
    const Frame frame(to_receiver);
    return frame.to_world(Vec3(sine * std::cos(phi), sine * std::sin(phi), cosine));
  }
};

}  // namespace etendue
