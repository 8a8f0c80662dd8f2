#include "camera/camera_motion.h"

#include "geometry/motion.h"

namespace etendue {

CameraMotion::CameraMotion(std::span<const Mat4> to_world) {
  for (const Mat4& m : to_world) poses_.push_back({glm::normalize(glm::quat_cast(Mat3(m))), Vec3(m[3])});
}

Mat4 CameraMotion::at(float time) const {
  const TimeSegment segment = time_segment(time, poses_.size());
  const Pose &before = poses_[segment.step], &after = poses_[segment.step + 1];
  Mat4 m(glm::mat3_cast(glm::slerp(before.rotation, after.rotation, segment.t)));
  m[3] = Vec4(glm::mix(before.position, after.position, segment.t), 1);
  return m;
}

}  // namespace etendue
