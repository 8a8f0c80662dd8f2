#include "camera/camera_ray.h"

namespace etendue {

CameraRays::CameraRays(const Camera& camera, int width, int height, std::shared_ptr<const CameraMotion> motion)
    : camera_(camera), motion_(std::move(motion)) {
  if (motion_) camera_.to_world = Mat4(1);
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

void CameraRays::place(float time, Ray& ray) const {
  const Mat4 to_world = motion_->at(time);
  ray.origin = Vec3(to_world * Vec4(ray.origin, 1));
  ray.direction = Mat3(to_world) * ray.direction;
}

Ray CameraRays::ray(Vec2 raster, Vec2 lens, float time) const {
  Ray ray = ray_of(raster, lens);
  if (motion_) place(time, ray);
  return ray;
}

void CameraRays::rays(const Pairs& raster, const Pairs& lens, const float* times, size_t count, Ray* rays) const {
  rays_in_place(raster, lens, count, rays);
  for (size_t i = 0; motion_ && i < count; ++i) place(times[i], rays[i]);
}

ETENDUE_VECTORIZE void CameraRays::rays_in_place(const Pairs& raster, const Pairs& lens, size_t count,
                                                 Ray* rays) const {
  struct Wide {
    Vec3Lanes<kMaxLanes> origin, direction;
    alignas(64) std::array<float, kMaxLanes> tnear, tfar;
  } wide;
  for (size_t first = 0; first < count; first += kMaxLanes) {
    for (size_t i = 0; i < kMaxLanes; ++i) {
      const Ray ray = ray_of({raster.x[first + i], raster.y[first + i]}, {lens.x[first + i], lens.y[first + i]});
      wide.origin.set(i, ray.origin), wide.direction.set(i, ray.direction);
      wide.tnear[i] = ray.tnear, wide.tfar[i] = ray.tfar;
    }
    for (size_t i = 0; i < std::min(kMaxLanes, count - first); ++i)
      rays[first + i] = {wide.origin[i], wide.tnear[i], wide.direction[i], wide.tfar[i]};
  }
}

}  // namespace etendue
