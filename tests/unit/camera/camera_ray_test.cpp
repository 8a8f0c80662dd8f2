// Camera rays: origins, focus, blur, and equality of the scalar and the vectorised versions.
#include "camera/camera_ray.h"

#include <gtest/gtest.h>

#include <random>

#include "base/vectorize.h"

namespace etendue {
namespace {

constexpr int kWidth = 160, kHeight = 90;

Camera camera_of(Projection projection, float lens_radius) {
  Camera camera = look_at({1, 2, 5}, {0, 1, 0}, {0, 1, 0}, 0.7f);
  camera.projection = projection;
  camera.lens_radius = lens_radius;
  camera.focus_distance = 3;
  camera.near_clip = 0.1f;
  camera.far_clip = 100;
  return camera;
}

TEST(CameraRays, GoThroughTheCentreOfTheImage) {
  const Camera camera = camera_of(Projection::perspective, 0);
  const Ray ray = CameraRays(camera, kWidth, kHeight).ray({kWidth / 2.0f, kHeight / 2.0f}, Vec2(0.5f));
  EXPECT_LT(glm::length(ray.direction - glm::normalize(Vec3(-1, -1, -5))), 1e-6f);
  EXPECT_EQ(ray.origin, Vec3(1, 2, 5));
  EXPECT_NEAR(ray.tnear, 0.1f, 1e-6f);
}

TEST(CameraRays, OfAPixelMeetInThePlaneInFocus) {
  const CameraRays rays(camera_of(Projection::perspective, 0.2f), kWidth, kHeight);
  const auto at_focus = [&](Vec2 lens) {
    const Ray ray = rays.ray({20, 30}, lens);
    const float axial = glm::dot(ray.direction, glm::normalize(Vec3(-1, -1, -5)));
    const float start = glm::dot(ray.origin - Vec3(1, 2, 5), glm::normalize(Vec3(-1, -1, -5)));
    return ray.origin + ray.direction * ((3 - start) / axial);
  };
  const Vec3 middle = at_focus(Vec2(0.5f));
  for (const Vec2 lens : {Vec2(0, 0), Vec2(0.9f, 0.1f), Vec2(0.3f, 0.8f)})
    EXPECT_LT(glm::length(at_focus(lens) - middle), 1e-5f);
  EXPECT_GT(glm::length(rays.ray({20, 30}, {0, 0}).origin - rays.ray({20, 30}, {0.9f, 0.9f}).origin), 0.3f);
}

// A lens of diameter D focused at z_f blurs a point at depth z to a disk of diameter D |1 - z_f / z| in the plane in
// focus [Lang, fig. 8.22]: the rays from the rim of the lens to the rim of the disk go through the point.
TEST(CameraRays, BlurAPointToTheDiskOfAThinLens) {
  constexpr float kRadius = 0.2f, kFocus = 3;
  Camera camera;
  camera.lens_radius = kRadius;
  camera.focus_distance = kFocus;
  camera.yfov = 1;
  const CameraRays rays(camera, kWidth, kHeight);
  const float pixels_per_metre = kHeight / (2 * kFocus * std::tan(0.5f * camera.yfov));
  for (const float z : {1.0f, 2.0f, 3.0f, 7.0f, 100.0f})
    for (const Vec2 lens : {Vec2(0, 0.5f), Vec2(1, 0.5f), Vec2(0.5f, 0), Vec2(0.3f, 1)}) {
      const Vec3 start = rays.ray({0, 0}, lens).origin;
      ASSERT_NEAR(glm::length(start), kRadius, 1e-6f) << "a point of the rim of the lens";
      const Vec2 on_focal_plane = Vec2(start) * (1 - kFocus / z);
      const Vec2 raster = Vec2(kWidth, kHeight) * 0.5f + Vec2(on_focal_plane.x, -on_focal_plane.y) * pixels_per_metre;
      const Ray ray = rays.ray(raster, lens);
      const Vec3 at_depth = ray.origin + ray.direction * (z / -ray.direction.z);
      EXPECT_LT(glm::distance(at_depth, Vec3(0, 0, -z)), 3e-6f * (1 + z)) << z;
      EXPECT_NEAR(2 * glm::length(on_focal_plane), 2 * kRadius * std::abs(1 - kFocus / z), 1e-6f);
    }
}

TEST(CameraRays, AreParallelInOrthographicProjection) {
  const CameraRays rays(camera_of(Projection::orthographic, 0), kWidth, kHeight);
  EXPECT_EQ(rays.ray({0, 0}, Vec2(0)).direction, rays.ray({150, 80}, Vec2(0)).direction);
  EXPECT_NE(rays.ray({0, 0}, Vec2(0)).origin, rays.ray({150, 80}, Vec2(0)).origin);
}

TEST(CameraRays, VectorisedVersionEqualsScalarVersion) {
  constexpr size_t kRays = 37;
  std::mt19937 engine(2);
  std::uniform_real_distribution<float> uniform(0, 1);
  alignas(64) std::array<float, 48> x{}, y{}, u{}, v{};
  for (size_t i = 0; i < kRays; ++i) {
    x[i] = kWidth * uniform(engine);
    y[i] = kHeight * uniform(engine);
    u[i] = uniform(engine);
    v[i] = uniform(engine);
  }
  for (const auto projection : {Projection::perspective, Projection::orthographic})
    for (const float radius : {0.0f, 0.3f}) {
      const CameraRays rays(camera_of(projection, radius), kWidth, kHeight);
      std::array<Ray, kRays> many;
      rays.rays({x.data(), y.data()}, {u.data(), v.data()}, nullptr, kRays, many.data());
      for (size_t i = 0; i < kRays; ++i) {
        const Ray one = rays.ray({x[i], y[i]}, {u[i], v[i]});
        EXPECT_EQ(many[i].origin, one.origin);
        EXPECT_EQ(many[i].direction, one.direction);
        EXPECT_EQ(many[i].tnear, one.tnear);
        EXPECT_EQ(many[i].tfar, one.tfar);
      }
    }
}

// `view` is the inverse of `ray`: the view of a point on a ray, through the same lens point, has the raster position of
// the ray.
TEST(CameraRays, ViewInvertsRay) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (const auto projection : {Projection::perspective, Projection::orthographic})
    for (const float radius : {0.0f, 0.3f}) {
      const CameraRays rays(camera_of(projection, radius), kWidth, kHeight);
      for (int i = 0; i < 50; ++i) {
        const Vec2 raster(kWidth * uniform(engine), kHeight * uniform(engine)), lens(uniform(engine), uniform(engine));
        const Ray ray = rays.ray(raster, lens);
        const float distance = 1 + 9 * uniform(engine);
        const auto view = rays.view(ray.origin + ray.direction * distance, lens);
        ASSERT_TRUE(view);
        EXPECT_LT(glm::distance(view->raster, raster), 1e-2f);
        EXPECT_LT(glm::distance(view->wi, -ray.direction), 1e-5f);
        EXPECT_NEAR(view->distance, distance - ray.tnear, 1e-4f);
        const float density = rays.pixels_per_area(ray.direction, distance);
        EXPECT_NEAR(view->importance / density, 1, 1e-3f);
      }
    }
}

}  // namespace
}  // namespace etendue
