// Rays that leave lights.                                         [Lang, sec. 9.2, eq. 9.33-9.35; Veach 1997, sec. 8.2]
#pragma once
#include "base/warp.h"
#include "light/sampling/light_sample.h"

namespace etendue {

// The densities of the two ends of a ray, in the order in which a light subpath generates them.
//
//   light           first                                       second
//   area            point, per area                             direction, per solid angle
//   point           point, discrete                             direction, per solid angle
//   environment     direction, per solid angle                  point on a disk across the ray, per area
//   directional     direction, discrete                         the same
//
// The first includes the probability of the light.
struct EmissionDensity {
  float first = 0, second = 0;
  bool delta = false;     // the light has no extent: no path ends on it
  bool infinite = false;  // the light is at infinity
};

struct Emission {
  LightKind kind = LightKind::triangle;
  uint32_t light = 0;
  Vec2 barycentric{0};    // weights of vertices 1 and 2 of a triangle; surface coordinates of a sphere or disk
  bool back = false;      // the ray leaves the back of an area light
  Vec3 position{0};       // of a point light; of a light at infinity a point outside the scene
  Vec3 direction{0};      // unit; of an area light in the frame of the side that it leaves
  bool textured = false;  // `radiance` is the mean of the triangle's texture; the scene has the value at the point
  Rgb radiance{0};        // cd/m^2; of a point light intensity, cd; of a directional light irradiance, lx
  float time = 0;         // 0 at the opening of the shutter, 1 at its closing
  float weight = 0;       // the cosine over both densities: radiance times weight is the flux of the ray, lm
  EmissionDensity density;
};

// Random numbers of one emission, each in [0, 1).
//
// `cosine_direction` is `direction` warped to the cosine distribution of a hemisphere: most lights need it, and it is
// faster to compute for many rays at once.
struct EmissionRandom {
  float choice;
  Vec2 point, direction;
  float time;
  Vec3 cosine_direction;

  EmissionRandom(float choice_, Vec2 point_, Vec2 direction_, float time_ = 0)
      : EmissionRandom(choice_, point_, direction_, time_, square_to_cosine_hemisphere(direction_)) {}
  EmissionRandom(float choice_, Vec2 point_, Vec2 direction_, float time_, const Vec3& cosine_direction_)
      : choice(choice_), point(point_), direction(direction_), time(time_), cosine_direction(cosine_direction_) {}
};

}  // namespace etendue
