#include "camera/camera_ray.h"

namespace etendue {

CameraRays::CameraRays(const Camera& camera, int width, int height) : camera_(camera) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const float half_height = camera.projection == Projection::perspective ? std::tan(0.5f * camera.yfov) : camera.ymag;
  half_size_ = Vec2(half_height * aspect, half_height);
  to_unit_ = Vec2(2 / static_cast<float>(width), 2 / static_cast<float>(height));
}

Ray CameraRays::ray(Vec2 raster, Vec2 lens) const {
  const Vec2 unit = raster * to_unit_ - 1.0f;
  const Vec2 on_picture(unit.x * half_size_.x, -unit.y * half_size_.y);
  Vec3 origin(0), direction;
  if (camera_.projection == Projection::orthographic) {
    origin = Vec3(on_picture, 0);
    direction = Vec3(0, 0, -1);
  } else {
    direction = Vec3(on_picture, -1);
  }
  if (camera_.lens_radius > 0) {
    const Vec3 focus = origin + direction * camera_.focus_distance;
    origin += Vec3(square_to_disk(lens) * camera_.lens_radius, 0);
    direction = focus - origin;
  }
  const float length = glm::length(direction);
  // Clipping planes are measured along the axis.
  const float axial = -direction.z / length;
  Ray ray;
  ray.origin = Vec3(camera_.to_world * Vec4(origin, 1));
  ray.direction = glm::normalize(Mat3(camera_.to_world) * direction);
  ray.tnear = camera_.near_clip / axial;
  ray.tfar = camera_.far_clip / axial;
  return ray;
}

}  // namespace etendue
