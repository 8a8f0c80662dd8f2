// The disk of a sun, prepared for sampling. Directions are uniform over its solid angle.
#pragma once
#include "base/frame.h"
#include "light/environment.h"

namespace etendue {

class SunCone {
 public:
  // `direction` is that of the centre in world space.
  SunCone(const SunDisk& sun, const Vec3& direction) : direction_(direction) {
    one_minus_cos_ = 2 * sqr(std::sin(0.5f * sun.angular_radius));
    chord2_ = 2 * one_minus_cos_;
    limb_darkening_ = sun.limb_darkening;
    central_radiance_ = sun.radiance / (1 - limb_darkening_ / 3);
    mean_ = sun.radiance;
  }

  float solid_angle() const { return 2 * kPi * one_minus_cos_; }
  const Rgb& mean_radiance() const { return mean_; }

  bool contains(const Vec3& direction) const { return length_squared(direction - direction_) < chord2_; }
  // cd/m^2; 0 outside of the disk.
  Rgb radiance(const Vec3& direction) const {
    const float share = length_squared(direction - direction_) / chord2_;
    if (!(share < 1)) return Rgb(0);
    return central_radiance_ * (1 - limb_darkening_ * (1 - std::sqrt(1 - share)));
  }
  float pdf(const Vec3& direction) const { return contains(direction) ? 1 / solid_angle() : 0; }
  Vec3 sample(Vec2 u) const {
    constexpr float kInside = 0.999999f;  // so that rounding does not leave the disk
    const float z = u.x * one_minus_cos_ * kInside;
    const float r = safe_sqrt(z * (2 - z));
    const float phi = 2 * kPi * u.y;
    return glm::normalize(Frame(direction_).to_world({r * std::cos(phi), r * std::sin(phi), 1 - z}));
  }

 private:
  Vec3 direction_;
  // A difference from one and a chord, because the cosine of a small angle loses its digits.
  float one_minus_cos_, chord2_, limb_darkening_;
  Rgb central_radiance_, mean_;
};

}  // namespace etendue
