// From a point of the scene, or a ray that comes in, to the picture.    digest 8-10: S20; thesis 9.2, (9.33)-(9.35)
#include "camera/camera_ray.h"

namespace etendue {

// Of a camera ray in perspective, in camera space.
// What returns two numbers in one register makes the caller wait: it becomes part of it.
[[gnu::always_inline]] inline Vec2 CameraRays::raster_of(const Vec3& direction, Vec2 on_lens) const {
  const float scale = -1 / direction.z;
  const Vec2 slope(direction.x * scale, direction.y * scale);
  // The point in focus is seen alike from all of the lens.
  const Vec2 on_picture = has_lens() ? on_lens / camera_.focus_distance + slope : slope;
  return (Vec2(on_picture.x, -on_picture.y) / half_size_ + 1.0f) / to_unit_;
}

// The picture at distance one has 1 / (4 half_size) of its pixels on a square metre, and shrinks with the cube of the
// cosine as seen from the lens.
float CameraRays::pixels_per_solid_angle(float cosine) const {
  return 1 / (to_unit_.x * to_unit_.y * half_size_.x * half_size_.y * cosine * sqr(cosine));
}

// Of a parallel projection.
float CameraRays::pixels_across(float cosine) const {
  return 1 / (to_unit_.x * to_unit_.y * half_size_.x * half_size_.y * cosine);
}

float CameraRays::pixels_per_area(const Vec3& direction, float distance, float time) const {
  const float c = cosine(direction, time);
  return parallel() ? pixels_across(c) : pixels_per_solid_angle(c) / sqr(distance);
}

std::optional<CameraRays::View> CameraRays::view(const Vec3& point, Vec2 lens, float time) const {
  const Mat4 placed = to_world(time);
  const Mat3 rotation(placed);
  const Vec3 local = glm::transpose(rotation) * (point - Vec3(placed[3]));
  const float depth = -local.z;
  if (!(depth > camera_.near_clip) || depth > camera_.far_clip) return {};
  const Vec2 on_lens = point_of_lens(lens);
  View view;
  if (parallel()) {
    // Through each point of the lens the scene is seen in one direction.
    const Vec3 slope(-on_lens / camera_.focus_distance, -1);
    const float length = std::sqrt(length_squared(slope)), cosine = 1 / length;
    const Vec2 on_picture = Vec2(local) - Vec2(slope) * depth - on_lens;
    view.raster = (Vec2(on_picture.x, -on_picture.y) / half_size_ + 1.0f) / to_unit_;
    view.wi = rotation * (slope * -cosine);
    view.distance = (depth - camera_.near_clip) * length;
    view.importance = pixels_across(cosine);
    return view;
  }
  const Vec3 to_lens = Vec3(on_lens, 0) - local;
  const float distance = std::sqrt(length_squared(to_lens)), cosine = depth / distance;
  view.raster = raster_of(-to_lens, on_lens);
  view.wi = rotation * (to_lens / distance);
  view.distance = distance - camera_.near_clip / cosine;
  view.importance = pixels_per_solid_angle(cosine) / sqr(distance);
  return view;
}

std::optional<CameraRays::DirectionView> CameraRays::view_direction(const Vec3& direction, Vec2 lens,
                                                                    float time) const {
  const Mat4 placed = to_world(time);
  const Mat3 rotation(placed);
  const Vec3 local = glm::transpose(rotation) * direction;
  const float cosine = -local.z;
  if (!sees_environment() || !(cosine > 0)) return {};
  const Vec2 on_lens = point_of_lens(lens);
  DirectionView view;
  view.raster = raster_of(local, on_lens);
  view.ray.origin = Vec3(placed * Vec4(on_lens, 0, 1));
  view.ray.direction = direction;
  view.ray.tnear = camera_.near_clip / cosine;
  view.importance = pixels_per_solid_angle(cosine);
  return view;
}

std::optional<CameraRays::LensHit> CameraRays::intersect_lens(const Ray& ray, float length, float time) const {
  if (!can_be_hit()) return {};
  const Mat4 placed = to_world(time);
  const Mat3 to_camera = glm::transpose(Mat3(placed));
  const Vec3 origin = to_camera * (ray.origin - Vec3(placed[3])), direction = to_camera * ray.direction;
  if (!(direction.z > 0) || !(origin.z < 0) || -origin.z > camera_.far_clip) return {};
  LensHit a;
  a.distance = -origin.z / direction.z;
  const Vec3 on_lens = origin + direction * a.distance;
  if (a.distance > length || sqr(on_lens.x) + sqr(on_lens.y) > sqr(camera_.lens_radius)) return {};
  a.raster = raster_of(-direction, Vec2(on_lens));
  a.cosine = direction.z;
  a.density = pixels_per_solid_angle(direction.z);
  a.importance = a.density / (lens_area() * direction.z);
  return a;
}

}  // namespace etendue
