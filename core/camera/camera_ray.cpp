#include "camera/camera_ray.h"

namespace etendue {

CameraRays::CameraRays(const Camera& camera, int width, int height) : camera_(camera) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const float half_height = camera.projection == Projection::perspective ? std::tan(0.5f * camera.yfov) : camera.ymag;
  half_size_ = Vec2(half_height * aspect, half_height);
  to_unit_ = Vec2(2 / static_cast<float>(width), 2 / static_cast<float>(height));
}

[[gnu::always_inline]] inline Ray CameraRays::ray_of(Vec2 raster, Vec2 lens) const {
  const Vec2 unit = raster * to_unit_ - 1.0f;
  const Vec2 on_picture(unit.x * half_size_.x, -unit.y * half_size_.y);
  const bool parallel = camera_.projection == Projection::orthographic;
  Vec3 origin = parallel ? Vec3(on_picture, 0) : Vec3(0);
  Vec3 direction = parallel ? Vec3(0, 0, -1) : Vec3(on_picture, -1);
  if (camera_.lens_radius > 0) {
    const Vec3 focus = origin + direction * camera_.focus_distance;
    origin += Vec3(square_to_disk(lens) * camera_.lens_radius, 0);
    direction = focus - origin;
  }
  direction *= 1 / std::sqrt(length_squared(direction));
  Ray ray;
  ray.origin = Vec3(camera_.to_world * Vec4(origin, 1));
  ray.direction = Mat3(camera_.to_world) * direction;
  // Clipping planes are measured along the axis.
  ray.tnear = camera_.near_clip / -direction.z;
  ray.tfar = camera_.far_clip / -direction.z;
  return ray;
}

Ray CameraRays::ray(Vec2 raster, Vec2 lens) const { return ray_of(raster, lens); }

ETENDUE_WIDE void CameraRays::rays(const Pairs& raster, const Pairs& lens, size_t count, Ray* rays) const {
  struct Wide {
    WideVec3<kWidest> origin, direction;
    alignas(64) std::array<float, kWidest> tnear, tfar;
  } wide;
  for (size_t first = 0; first < count; first += kWidest) {
    for (size_t i = 0; i < kWidest; ++i) {
      const Ray ray = ray_of({raster.x[first + i], raster.y[first + i]}, {lens.x[first + i], lens.y[first + i]});
      wide.origin.set(i, ray.origin), wide.direction.set(i, ray.direction);
      wide.tnear[i] = ray.tnear, wide.tfar[i] = ray.tfar;
    }
    for (size_t i = 0; i < std::min(kWidest, count - first); ++i)
      rays[first + i] = {wide.origin[i], wide.tnear[i], wide.direction[i], wide.tfar[i]};
  }
}

}  // namespace etendue
