#include "camera/camera_motion.h"

namespace etendue {

CameraMotion::CameraMotion(std::span<const Mat4> places) {
  for (const Mat4& m : places) places_.push_back({glm::normalize(glm::quat_cast(Mat3(m))), Vec3(m[3])});
}

Mat4 CameraMotion::at(float time) const {
  const auto segments = static_cast<float>(places_.size() - 1);
  const float moment = time * segments, step = std::min(std::floor(moment), segments - 1), part = moment - step;
  const Place &before = places_[static_cast<size_t>(step)], &after = places_[static_cast<size_t>(step) + 1];
  Mat4 m(glm::mat3_cast(glm::slerp(before.rotation, after.rotation, part)));
  m[3] = Vec4(glm::mix(before.position, after.position, part), 1);
  return m;
}

}  // namespace etendue
