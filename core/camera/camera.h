// Cameras: what a user edits.                                               thesis 8.3 (S10-S13 of the measurement)
#pragma once
#include <string>

#include "base/vec.h"

namespace etendue {

enum class Projection : uint8_t { perspective, orthographic };

struct Camera {
  std::string name;
  Projection projection = Projection::perspective;
  Mat4 to_world{1};          // looks along its -z, +y up; rotation and translation only
  float yfov = 0.8f;         // radians, perspective
  float ymag = 1;            // half the height of the picture in metres, orthographic
  float aspect = 0;          // width / height the author asked for; 0 if the file leaves it to the window
  float lens_radius = 0;     // metres; 0 is a pinhole
  float focus_distance = 1;  // metres from the lens along -z
  float shutter = 0;         // seconds that it stays open from the scene's time on; 0 is an instant
  float near_clip = 0, far_clip = kInfinity;

  friend bool operator==(const Camera&, const Camera&) = default;
};

// A camera at `eye` that looks at `target`.
Camera look_at(const Vec3& eye, const Vec3& target, const Vec3& up, float yfov);

}  // namespace etendue
