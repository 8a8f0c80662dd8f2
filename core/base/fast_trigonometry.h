// Trigonometric functions by polynomials: a few operations instead of a call, and the same bits on all machines.
// [Abramowitz and Stegun 1964, eq. 4.4.46 and 4.4.49]
#pragma once
#include <algorithm>
#include <cmath>

#include "base/warp.h"

namespace etendue {

// (cos 2 pi t, sin 2 pi t) for |t| < 1e6, with an error of at most 2e-7 for the rounded t. In turns, the reduction to an
// octant is exact.
inline Vec2 cos_sin_of_turns(float t) {
  const float quarters = std::floor(4 * t + 0.5f);
  const Vec2 d = cos_sin_of_octant((4 * t - quarters) * (kPi / 2));
  const int quadrant = static_cast<int>(quarters) & 3;
  const bool swapped = (quadrant & 1) != 0;
  const float cosine = select(swapped, d.y, d.x), sine = select(swapped, d.x, d.y);
  return {select(quadrant == 1 || quadrant == 2, -cosine, cosine), select(quadrant >= 2, -sine, sine)};
}

// The arc cosine of x in [-1, 1]; the absolute error is below 5e-7.
inline float fast_acos(float x) {
  const float a = std::min(std::abs(x), 1.0f);
  float p = -0.0012624911f;
  for (const float c :
       {0.0066700901f, -0.0170881256f, 0.0308918810f, -0.0501743046f, 0.0889789874f, -0.2145988016f, 1.5707963050f})
    p = p * a + c;
  const float angle = std::sqrt(1 - a) * p;
  return x < 0 ? kPi - angle : angle;
}

// The angle of (x, y) in [-pi, pi], 0 for (0, 0); the absolute error is below 5e-7.
inline float fast_atan2(float y, float x) {
  const float ax = std::abs(x), ay = std::abs(y), larger = std::max(ax, ay);
  const float t = larger > 0 ? std::min(ax, ay) / larger : 0, t2 = t * t;
  float p = 0.0028662257f;
  for (const float c : {-0.0161657367f, 0.0429096138f, -0.0752896400f, 0.1065626393f, -0.1420889944f, 0.1999355085f,
                        -0.3333314528f, 1.0f})
    p = p * t2 + c;
  float angle = p * t;
  if (ay > ax) angle = 0.5f * kPi - angle;
  if (x < 0) angle = kPi - angle;
  return std::copysign(angle, y);
}

}  // namespace etendue
