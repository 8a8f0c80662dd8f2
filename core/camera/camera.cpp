#include "camera/camera.h"

namespace etendue {

Camera look_at(const Vec3& eye, const Vec3& target, const Vec3& up, float yfov) {
  const Vec3 back = normalize_or(eye - target, Vec3(0, 0, 1));
  Vec3 right = glm::cross(up, back);
  if (!(length_squared(right) > 1e-12f))
    right = glm::cross(std::abs(back.x) < 0.9f ? Vec3(1, 0, 0) : Vec3(0, 0, 1), back);
  right = glm::normalize(right);
  Camera camera;
  camera.to_world = Mat4(Vec4(right, 0), Vec4(glm::cross(back, right), 0), Vec4(back, 0), Vec4(eye, 1));
  camera.yfov = yfov;
  camera.focus_distance = std::max(glm::length(eye - target), 1e-6f);
  return camera;
}

}  // namespace etendue
