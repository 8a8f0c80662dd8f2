#include "viewer/tools/camera_controller.h"

#include <glm/gtc/matrix_transform.hpp>

#include "camera/camera.h"
#include "geometry/mesh.h"
#include "render/image_sequence.h"
#include "scene/compiled_scene.h"

namespace etendue::viewer {
namespace {

constexpr float kRadiansPerPixel = 0.005f;
constexpr float kMinPoleAngle = 0.02f;  // radians between the view direction and the vertical
constexpr float kDollyFactor = 0.88f;   // of the distance, per notch of the wheel

Vec3 eye_of(const Camera& camera) { return Vec3(camera.to_world[3]); }
Vec3 back_of(const Camera& camera) { return Vec3(camera.to_world[2]); }

// A rotation about the vertical axis and the right axis of the camera. The pitch is limited so that the camera stays
// upright.
Mat3 rotation(const Camera& camera, float yaw, float pitch) {
  const Vec3 back = back_of(camera);
  const float elevation = std::asin(std::clamp(back.y, -1.0f, 1.0f));
  const float limit = kPi / 2 - kMinPoleAngle;
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

void CameraController::reset_pivot(const Camera& camera, const scene::CompiledScene& scene) {
  const Bounds& bounds = scene.bounds();
  pivot_ = render::orbit_centre(camera, scene);
  fly_speed_ = bounds.empty() ? 1.0f : std::max(0.4f * bounds.radius(), 1e-4f);
}

Camera CameraController::orbit(Camera camera, Vec2 movement) const {
  const Mat3 rotate = rotation(camera, -movement.x * kRadiansPerPixel, movement.y * -kRadiansPerPixel);
  move_to(camera, pivot_ + rotate * (eye_of(camera) - pivot_));
  set_axes(camera, rotate * Mat3(camera.to_world));
  return camera;
}

Camera CameraController::look_around(Camera camera, Vec2 movement) const {
  const Mat3 rotate = rotation(camera, -movement.x * kRadiansPerPixel * 0.5f, movement.y * -kRadiansPerPixel * 0.5f);
  set_axes(camera, rotate * Mat3(camera.to_world));
  return camera;
}

Camera CameraController::pan(Camera camera, Vec2 movement, float image_height) {
  const float distance = std::max(glm::dot(eye_of(camera) - pivot_, back_of(camera)), 1e-6f);
  const float visible_height =
      camera.projection == Projection::perspective ? 2 * std::tan(0.5f * camera.yfov) * distance : 2 * camera.ymag;
  const float metres = visible_height / std::max(image_height, 1.0f);
  const Vec3 move = (Vec3(camera.to_world[0]) * -movement.x + Vec3(camera.to_world[1]) * movement.y) * metres;
  move_to(camera, eye_of(camera) + move);
  pivot_ += move;
  return camera;
}

Camera CameraController::dolly(Camera camera, const Vec3& target, float notches) const {
  const float scale = std::pow(kDollyFactor, notches);
  if (camera.projection == Projection::orthographic) {
    // The point under the pointer keeps its position in the image.
    const Vec3 to_target = target - eye_of(camera);
    const Vec3 across = to_target - back_of(camera) * glm::dot(to_target, back_of(camera));
    move_to(camera, eye_of(camera) + across * (1 - scale));
    camera.ymag *= scale;
    return camera;
  }
  move_to(camera, target + (eye_of(camera) - target) * scale);
  return camera;
}

Camera CameraController::fly(Camera camera, const Vec3& direction, float seconds) const {
  move_to(camera, eye_of(camera) + Mat3(camera.to_world) * direction * (fly_speed_ * seconds));
  return camera;
}

Camera CameraController::frame(Camera camera, const Bounds& bounds, float aspect) {
  if (bounds.empty()) return camera;
  const float radius = std::max(bounds.radius(), 1e-6f);
  const float narrow_side = std::min(1.0f, aspect);
  if (camera.projection == Projection::orthographic) camera.ymag = radius / narrow_side;
  const float half_angle = std::atan(std::tan(0.5f * camera.yfov) * narrow_side);
  const float distance = camera.projection == Projection::perspective ? radius / std::sin(half_angle) : 2 * radius;
  pivot_ = bounds.center();
  move_to(camera, pivot_ + back_of(camera) * distance);
  return camera;
}

}  // namespace etendue::viewer
