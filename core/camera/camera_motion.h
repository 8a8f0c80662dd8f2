// Motion of a camera while the shutter is open                                          [Lang, sec. 8.4.3.3, eq. 8.61]
//
// A CameraMotion stores poses at times evenly spaced from the opening (time 0) to the closing of the shutter (time 1).
// Between two poses, the position is interpolated linearly and the rotation with constant angular velocity. Linear
// interpolation of the matrices would scale the image.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "base/vec.h"

namespace etendue {

class CameraMotion {
 public:
  // Camera::to_world at two or more times.
  explicit CameraMotion(std::span<const Mat4> to_world);

  // Camera::to_world at a time in [0, 1].
  Mat4 at(float time) const;

 private:
  struct Pose {
    glm::quat rotation;
    Vec3 position;
  };
  std::vector<Pose> poses_;
};

}  // namespace etendue
