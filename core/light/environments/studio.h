// A photographer's studio: grey walls and softboxes.
#pragma once
#include <algorithm>
#include <cmath>

#include "light/environments/builtin_environment.h"

namespace etendue {

// A rectangular light by its centre and half its size, in degrees. Azimuth 0 is the front, +90 the right.
struct Softbox {
  float azimuth, elevation, half_width, half_height;
  Rgb radiance;
};

inline Rgb radiance_of(const Softbox& box, float azimuth, float elevation) {
  constexpr float kSoftEdge = 0.2f;  // of half the size
  const auto inside = [](float x, float half) {
    const float t = std::clamp((half - std::abs(x)) / (kSoftEdge * half), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
  };
  const float turn = std::remainder(azimuth - box.azimuth, 360.0f);
  return box.radiance * (inside(turn, box.half_width) * inside(elevation - box.elevation, box.half_height));
}

// A key light on the left, a narrow fill light on the right, a rim light from behind and light from above. A white
// surface that faces the camera has a radiance of about 1; the walls, which are the background, are darker.
inline Rgb studio_radiance(const Vec3& direction) {
  constexpr float kDegrees = 180 / kPi;
  const Softbox boxes[] = {
      {-48, 44, 30, 20, Rgb(5.2f, 5.0f, 4.7f)}, {72, 38, 11, 26, Rgb(3.9f, 4.2f, 4.7f)}, {165, 48, 34, 12, Rgb(5)}};
  const float azimuth = std::atan2(direction.x, direction.z) * kDegrees;
  const float elevation = std::asin(std::clamp(direction.y, -1.0f, 1.0f)) * kDegrees;
  // The walls become darker towards the floor.
  const float t = std::clamp((direction.y + 0.5f) / 1.2f, 0.0f, 1.0f);
  Rgb radiance = Rgb(0.13f + 0.22f * t * t * (3 - 2 * t));
  for (const Softbox& box : boxes) radiance += radiance_of(box, azimuth, elevation);
  const float above = std::clamp((direction.y - 0.92f) / 0.05f, 0.0f, 1.0f);
  return radiance + Rgb(1.6f * above);
}

constexpr BuiltinEnvironment kStudio{
    .name = "studio",
    .label = "Studio",
    .doc = "Softboxes in a grey room: shows shape and gloss of an object in front of a neutral background",
    .radiance = studio_radiance};

}  // namespace etendue
