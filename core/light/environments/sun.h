// The sun of both skies: a disk of 0.533 degrees, a black body of 5778 K with an illuminance of 128 klx above the
// atmosphere, attenuated by Rayleigh scattering, aerosols and ozone along the air mass of its elevation.
//                                                                                       [Kasten 1966; Leckner 1978]
#pragma once
#include "light/environment.h"

namespace etendue {

inline constexpr float kSunAngularRadius = 0.5f * 0.533f * kPi / 180;  // radians

struct SunAngles {
  float elevation = 0;  // radians; at night 0
  float azimuth = 0;    // radians; 0 is +z, pi / 2 is +x
  bool is_up = true;
};
// Those of the sky, or those of its place and time: -z is north, +x is east. The declination of the sun is that of Cooper
// [1969], which is accurate to half a degree.
SunAngles sun_angles(const Sky& sky);

// The unit direction towards the sun; at night towards the horizon.
Vec3 sun_direction(const Sky& sky);
// The mean radiance of the sun's disk behind the atmosphere, cd/m^2; at night 0.
Rgb sun_radiance(const Sky& sky);
// sr
float solid_angle_of_sun();

}  // namespace etendue
