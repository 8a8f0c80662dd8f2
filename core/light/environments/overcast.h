// A cloudy sky above a grey ground.
#pragma once
#include "light/environments/builtin_environment.h"

namespace etendue {

// The CIE overcast sky [Moon and Spencer 1942]: L = L_z (1 + 2 sin(elevation)) / 3. L_z is chosen such that a white
// horizontal surface has radiance 1; the ground reflects a quarter.
inline Rgb overcast_radiance(const Vec3& direction) {
  constexpr float kZenith = 9.0f / 7;
  if (direction.y < 0) return Rgb(0.25f);
  return Rgb(0.97f, 1, 1.04f) * (kZenith * (1 + 2 * direction.y) / 3);
}

constexpr BuiltinEnvironment kOvercast{.name = "overcast",
                                       .label = "Overcast sky",
                                       .doc = "Soft light from a cloudy sky without visible shadows",
                                       .radiance = overcast_radiance};

}  // namespace etendue
