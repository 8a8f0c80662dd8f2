// How a camera moves while the shutter is open.                                            thesis 8.3.4, (8.61)
//
// Places at moments evenly spaced from the opening (time 0) to the closing (time 1). In between it turns at an even
// rate and goes straight on: a mixture of two matrices would shrink the picture.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "base/vec.h"

namespace etendue {

class CameraMotion {
 public:
  // Camera::to_world at these moments, two or more.
  explicit CameraMotion(std::span<const Mat4> places);

  // Camera::to_world at a time in [0, 1].
  Mat4 at(float time) const;

 private:
  struct Place {
    glm::quat rotation;
    Vec3 position;
  };
  std::vector<Place> places_;
};

}  // namespace etendue
