#include "viewer/tools/camera_controller.h"

#include <glm/gtc/matrix_transform.hpp>

#include "camera/camera_ray.h"
#include "scene/compiled_scene.h"

namespace etendue::viewer {
namespace {

constexpr float kRadiansPerPixel = 0.005f;
constexpr float kNearestToPole = 0.02f;  // radians

Vec3 eye_of(const Camera& camera) { return Vec3(camera.to_world[3]); }
Vec3 back_of(const Camera& camera) { return Vec3(camera.to_world[2]); }

// Turns about the vertical and the camera's right, without going over the poles. The camera stays upright.
Mat3 turned(const Camera& camera, float yaw, float pitch) {
  const Vec3 back = back_of(camera);
  const float elevation = std::asin(std::clamp(back.y, -1.0f, 1.0f));
  const float limit = kPi / 2 - kNearestToPole;
  const float bounded = std::clamp(elevation - pitch, -limit, limit) - elevation;
  const Mat4 about_up = glm::rotate(Mat4(1), yaw, Vec3(0, 1, 0));
  return Mat3(about_up * glm::rotate(Mat4(1), -bounded, Vec3(camera.to_world[0])));
}

void set_axes(Camera& camera, const Mat3& axes) {
  const Vec3 back = normalize_or(axes[2], Vec3(0, 0, 1));
  const Vec3 right = normalize_or(axes[0] - back * glm::dot(axes[0], back), Vec3(1, 0, 0));
  camera.to_world[0] = Vec4(right, 0);
  camera.to_world[1] = Vec4(glm::cross(back, right), 0);
  camera.to_world[2] = Vec4(back, 0);
}

void move_to(Camera& camera, const Vec3& eye) { camera.to_world[3] = Vec4(eye, 1); }

}  // namespace

std::optional<Picked> pick(const render::Document& document, const scene::CompiledScene& scene,
                           const Placement& picture, Vec2 at) {
  if (!picture.contains(at)) return std::nullopt;
  Camera pinhole = document.camera;
  pinhole.lens_radius = 0;
  const Vec2 raster = (at - picture.corner) / picture.size * Vec2(document.width, document.height);
  const Ray ray = CameraRays(pinhole, document.width, document.height).ray(raster, Vec2(0.5f));
  const Hit hit = scene.intersect(ray, 0);
  if (!hit) return std::nullopt;
  const auto& instance = scene.instances()[hit.instance];
  Picked picked;
  picked.position = ray.origin + ray.direction * hit.t;
  picked.axial_distance = glm::dot(eye_of(pinhole) - picked.position, back_of(pinhole));
  picked.node = static_cast<int>(instance.node);
  picked.material = static_cast<int>(instance.material);
  return picked;
}

void CameraHand::find_pivot(const Camera& camera, const scene::CompiledScene& scene) {
  const Bounds& bounds = scene.bounds();
  const Ray axis{eye_of(camera), 0, -back_of(camera), kInfinity};
  const Hit hit = scene.intersect(axis, 0);
  const float to_middle = bounds.empty() ? 1.0f : glm::dot(bounds.center() - axis.origin, axis.direction);
  const float distance = hit ? hit.t : std::max(to_middle, 0.1f * std::max(bounds.radius(), 1e-3f));
  pivot_ = axis.origin + axis.direction * distance;
  speed_ = bounds.empty() ? 1.0f : std::max(0.4f * bounds.radius(), 1e-4f);
}

Camera CameraHand::orbit(Camera camera, Vec2 amount) const {
  const Mat3 turn = turned(camera, -amount.x * kRadiansPerPixel, amount.y * -kRadiansPerPixel);
  move_to(camera, pivot_ + turn * (eye_of(camera) - pivot_));
  set_axes(camera, turn * Mat3(camera.to_world));
  return camera;
}

Camera CameraHand::look_around(Camera camera, Vec2 amount) const {
  const Mat3 turn = turned(camera, -amount.x * kRadiansPerPixel * 0.5f, amount.y * -kRadiansPerPixel * 0.5f);
  set_axes(camera, turn * Mat3(camera.to_world));
  return camera;
}

Camera CameraHand::pan(Camera camera, Vec2 amount, float height) {
  const float distance = std::max(glm::dot(eye_of(camera) - pivot_, back_of(camera)), 1e-6f);
  const float visible =
      camera.projection == Projection::perspective ? 2 * std::tan(0.5f * camera.yfov) * distance : 2 * camera.ymag;
  const float metres = visible / std::max(height, 1.0f);
  const Vec3 move = (Vec3(camera.to_world[0]) * -amount.x + Vec3(camera.to_world[1]) * amount.y) * metres;
  move_to(camera, eye_of(camera) + move);
  pivot_ += move;
  return camera;
}

Camera CameraHand::dolly(Camera camera, const Vec3& target, float notches) const {
  const float closer = std::pow(0.88f, notches);
  if (camera.projection == Projection::orthographic) {
    // The point under the cursor stays where it is.
    const Vec3 aside = target - eye_of(camera);
    const Vec3 across = aside - back_of(camera) * glm::dot(aside, back_of(camera));
    move_to(camera, eye_of(camera) + across * (1 - closer));
    camera.ymag *= closer;
    return camera;
  }
  move_to(camera, target + (eye_of(camera) - target) * closer);
  return camera;
}

Camera CameraHand::fly(Camera camera, const Vec3& direction, float seconds) const {
  move_to(camera, eye_of(camera) + Mat3(camera.to_world) * direction * (speed_ * seconds));
  return camera;
}

Camera CameraHand::frame(Camera camera, const Bounds& bounds, float aspect) {
  if (bounds.empty()) return camera;
  const float radius = std::max(bounds.radius(), 1e-6f);
  const float narrow = std::min(1.0f, aspect);
  if (camera.projection == Projection::orthographic) camera.ymag = radius / narrow;
  const float half = std::atan(std::tan(0.5f * camera.yfov) * narrow);
  const float distance = camera.projection == Projection::perspective ? radius / std::sin(half) : 2 * radius;
  pivot_ = bounds.center();
  move_to(camera, pivot_ + back_of(camera) * distance);
  return camera;
}

Bounds bounds_of_node(const scene::CompiledScene& scene, int node) {
  Bounds bounds;
  for (const auto& instance : scene.instances())
    if (static_cast<int>(instance.node) == node) bounds.extend(bounds_of(*instance.mesh, instance.to_world));
  return bounds;
}

std::optional<Vec2> project(const Camera& camera, const Placement& picture, const Vec3& point) {
  const Vec3 p = Vec3(glm::inverse(camera.to_world) * Vec4(point, 1));
  const bool perspective = camera.projection == Projection::perspective;
  if (perspective && p.z > -1e-4f * std::max(1e-3f, glm::length(p))) return std::nullopt;
  const float half = perspective ? std::tan(0.5f * camera.yfov) * -p.z : camera.ymag;
  const float aspect = picture.size.x / picture.size.y;
  const Vec2 unit(p.x / (half * aspect), -p.y / half);
  return picture.corner + (unit * 0.5f + 0.5f) * picture.size;
}

}  // namespace etendue::viewer
