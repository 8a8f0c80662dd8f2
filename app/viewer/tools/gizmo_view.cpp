#include "viewer/tools/gizmo_view.h"

#include <algorithm>
#include <cmath>

#include "camera/camera_ray.h"
#include "camera/segment_projection.h"
#include "render/document.h"

namespace etendue::viewer {

std::optional<Vec2> GizmoView::project(const Vec3& point) const {
  const auto ends = project_segment(document_.camera, Vec2i(image_.size), point, point);
  return ends ? std::optional(image_.corner + (*ends)[0]) : std::nullopt;
}

Ray GizmoView::ray(Vec2 position) const {
  Camera pinhole = document_.camera;
  pinhole.lens_radius = 0;
  const Vec2 raster = (position - image_.corner) / image_.size * Vec2(document_.width, document_.height);
  return CameraRays(pinhole, document_.width, document_.height).ray(raster, Vec2(0.5f));
}

float GizmoView::pixel_size(const Vec3& point) const {
  const Camera& camera = document_.camera;
  const float distance = glm::dot(Vec3(camera.to_world[3]) - point, Vec3(camera.to_world[2]));
  const float height = camera.projection == Projection::perspective
                           ? 2 * std::tan(0.5f * camera.yfov) * std::max(distance, 1e-6f)
                           : 2 * camera.ymag;
  return height / std::max(image_.size.y, 1.0f);
}

Vec3 GizmoView::towards_camera(const Vec3& point) const {
  const Camera& camera = document_.camera;
  const Vec3 back(camera.to_world[2]);
  if (camera.projection == Projection::orthographic) return back;
  return normalize_or(Vec3(camera.to_world[3]) - point, back);
}

std::optional<float> nearest_on_line(const Vec3& origin, const Vec3& direction, const Ray& ray) {
  constexpr float kParallel = 1e-4f;
  const float cosine = glm::dot(direction, ray.direction);
  const float squared_sine = 1 - cosine * cosine;
  if (!(squared_sine > kParallel)) return std::nullopt;
  const Vec3 between = ray.origin - origin;
  return (glm::dot(between, direction) - glm::dot(between, ray.direction) * cosine) / squared_sine;
}

std::optional<Vec3> meet_plane(const Vec3& origin, const Vec3& normal, const Ray& ray) {
  constexpr float kParallel = 1e-3f;
  const float cosine = glm::dot(normal, ray.direction);
  if (!(std::abs(cosine) > kParallel)) return std::nullopt;
  const float t = glm::dot(origin - ray.origin, normal) / cosine;
  return t > 0 ? std::optional(ray.origin + ray.direction * t) : std::nullopt;
}

float distance_to_segment(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 along = to - from;
  const float squared = glm::dot(along, along);
  const float t = squared > 0 ? std::clamp(glm::dot(point - from, along) / squared, 0.0f, 1.0f) : 0;
  return glm::length(point - from - along * t);
}

}  // namespace etendue::viewer
