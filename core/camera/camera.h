// Cameras as a user edits them                                                                  [Lang, sec. 8.4.3]
#pragma once
#include <string>

#include "base/vec.h"

namespace etendue {

enum class Projection : uint8_t { perspective, orthographic };

struct Camera {
  std::string name;
  Projection projection = Projection::perspective;
  Mat4 to_world{1};                           // rotation and translation only; the camera looks along -z, +y is up
  float yfov = 0.8f;                          // vertical field of view in radians; perspective only
  float ymag = 1;                             // half the height of the image in metres; orthographic only
  float aspect = 0;                           // width / height of the image; 0 if the file leaves it to the application
  float lens_radius = 0;                      // metres; 0 is a pinhole
  float focus_distance = 1;                   // metres from the lens along -z
  float shutter = 0;                          // seconds from the opening to the closing; 0 is an instant
  float near_clip = 0, far_clip = kInfinity;  // metres along -z

  friend bool operator==(const Camera&, const Camera&) = default;
};

// A perspective camera at `eye` that looks at `target` and is focused on it. `yfov` is in radians.
Camera look_at(const Vec3& eye, const Vec3& target, const Vec3& up, float yfov);

}  // namespace etendue
