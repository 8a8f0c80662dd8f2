// Moving cameras: interpolation of poses, and rays equal to those of a static camera at the same pose.
#include "camera/camera_motion.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "camera/camera_ray.h"

namespace etendue {
namespace {

constexpr int kWidth = 16, kHeight = 9;

std::vector<Mat4> turning_poses() {
  std::vector<Mat4> poses;
  for (const float angle : {0.0f, 1.0f, 2.0f, 3.0f})
    poses.push_back(glm::rotate(glm::translate(Mat4(1), Vec3(angle, 0, 2 * angle)), angle, Vec3(0, 1, 0)));
  return poses;
}

TEST(CameraMotion, RotatesAtConstantRateWithoutScaling) {
  const CameraMotion motion(turning_poses());
  for (int i = 0; i <= 30; ++i) {
    const float time = static_cast<float>(i) / 30, angle = 3 * time;
    const Mat4 expected = glm::rotate(glm::translate(Mat4(1), Vec3(angle, 0, 2 * angle)), angle, Vec3(0, 1, 0));
    for (int c = 0; c < 4; ++c) EXPECT_LT(glm::distance(motion.at(time)[c], expected[c]), 2e-6f) << time;
  }
}

TEST(CameraRays, OfAMovingCameraEqualThoseAtItsPose) {
  const auto motion = std::make_shared<const CameraMotion>(turning_poses());
  for (const auto projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera;
    camera.projection = projection;
    camera.lens_radius = 0.1f;
    camera.focus_distance = 2;
    camera.to_world = turning_poses().front();
    const CameraRays moving(camera, kWidth, kHeight, motion);
    alignas(64) std::array<float, 16> x{}, y{}, u{}, v{}, times{};
    for (size_t i = 0; i < x.size(); ++i) {
      const float part = static_cast<float>(i) / 16;
      x[i] = kWidth * part;
      y[i] = kHeight * (1 - part);
      u[i] = part;
      v[i] = 0.3f;
      times[i] = part;
    }
    std::array<Ray, 16> rays;
    moving.rays({x.data(), y.data()}, {u.data(), v.data()}, times.data(), rays.size(), rays.data());
    for (size_t i = 0; i < x.size(); ++i) {
      camera.to_world = motion->at(times[i]);
      const Ray still = CameraRays(camera, kWidth, kHeight).ray({x[i], y[i]}, {u[i], v[i]});
      for (const Ray& ray : {rays[i], moving.ray({x[i], y[i]}, {u[i], v[i]}, times[i])}) {
        EXPECT_LT(glm::distance(ray.origin, still.origin), 1e-6f);
        EXPECT_LT(glm::distance(ray.direction, still.direction), 1e-6f);
        EXPECT_EQ(ray.tnear, still.tnear);
      }
    }
  }
}

}  // namespace
}  // namespace etendue
