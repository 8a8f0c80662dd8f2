// Ray casting, Appel's shadows and Whitted ray tracing [Lang, sec. 8.2]: closed forms, comparisons with each other, and
// with path tracing restricted to the same path classes. The formulas are [Lang, eq. 8.14, 8.19, corrected; 8.24-8.33,
// corrected].
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "camera/camera_ray.h"
#include "integrator/integrator.h"
#include "support/integrator_scenes.h"

namespace etendue::classic_test {
namespace {

using test::expect_agreement;
using test::replicated;
using test::same_bits;
using test::with;
using test::with_integrator;

render::Document relit(const render::Document& d, const std::function<void(scene::Scene&)>& change) {
  render::Document changed = d;
  scene::Scene scene = *d.scene;
  change(scene);
  changed.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return changed;
}

// Mirrors, clear glass as a thin sheet and as a ball, glaze and rough metal under an area light and an environment, or
// under two point lights.
render::Document mirrors(bool points) {
  return relit(test::glossy_scene(), [&](scene::Scene& scene) {
    for (Material& m : scene.materials)
      if (m.transmission > 0 || (m.metallic == 0 && m.specular == 1)) m.roughness = 0;
    Material mirror;
    mirror.base_color = {0.8f, 0.9f, 0.9f};
    mirror.metallic = 1;
    mirror.roughness = 0;
    Mat4 upright(1);
    upright[1] = Vec4(0, 0, 1, 0);
    upright[2] = Vec4(0, -1, 0, 0);
    upright[3] = Vec4(0, 1, -2, 1);
    test::add(scene, test::quad(3), mirror, upright);
    if (!points) return;
    for (Material& m : scene.materials) m.emission = Rgb(0);
    scene.environment.tint = Rgb(0);
    test::add_point_light(scene, {0.5f, 3, 1.5f}, 20);
    test::add_point_light(scene, {-2, 2, 2}, 8);
  });
}

// Point lights of 100 W, 2 m above a diffuse surface of albedo 0.5. One light gives L = (rho / pi) (Phi / 4 pi) / d^2 =
// 0.3166287 W/(m^2 sr) [Lang, eq. 8.14].
render::Document floor_under_points(int lights) {
  scene::Scene scene;
  test::add(scene, test::quad(10), test::diffuse(Rgb(0.5f)));
  for (int i = 0; i < lights; ++i) test::add_point_light(scene, {0, 2, 0}, 100 / (4 * kPi));
  return test::document(scene, look_at({1, 1, 0}, {0, 0, 0}, {0, 1, 0}, 1e-4f), 4, 4);
}

TEST(Classic, RadianceOfPointLightsIsSummed) {
  for (const int lights : {1, 2, 5})
    for (const char* method : {"raycast", "appel", "whitted", "distribution", "path"}) {
      const double mean = test::mean_of(test::rendered(with_integrator(floor_under_points(lights), method), 4)).value;
      EXPECT_NEAR(mean, lights * 0.31662870, lights * 1e-5) << method << ' ' << lights;
    }
  const auto plain = with(with_integrator(floor_under_points(1), "raycast"), "raycast.local", "off");
  EXPECT_EQ(test::mean_of(test::rendered(plain, 4)).value, 0);
}

// More lights than one wavefront has connection slots.
TEST(Classic, RadianceOfManyLightsIsSummed) {
  auto d = floor_under_points(100);
  d.width = d.height = 32;
  for (const char* method : {"raycast", "appel", "whitted"})
    EXPECT_NEAR(test::mean_of(test::rendered(with_integrator(d, method), 2)).value, 31.662870, 2e-3) << method;
}

// Below a disk of radius r at height h: L = rho L_e r^2 / (r^2 + h^2) [Lang, eq. 10.81]. Two coincident disks give
// twice the radiance.
TEST(Classic, DiskLight) {
  constexpr float kCases[][2] = {{1, 1}, {0.5f, 1}, {2, 1}, {0.1f, 1}};
  for (const auto& [r, h] : kCases)
    for (const int lights : {1, 2}) {
      scene::Scene scene;
      test::add(scene, test::quad(10), test::diffuse(Rgb(0.5f)));
      Material light = test::diffuse(Rgb(0), Rgb(3));
      light.double_sided = false;
      Mat4 place(1);
      place[1][1] = -1;
      place[2][2] = -1;
      place[3] = Vec4(0, h, 0, 1);
      for (int i = 0; i < lights; ++i) {
        test::add(scene, test::disk(r, 128), light, place);
        place[3].y += 1e-3f * h;  // the back of the lower disk occludes the upper one
      }
      const Vec3 eye(3 * std::max(r, h), 0.8f * h, 0);
      const auto d = test::document(scene, look_at(eye, {0, 0, 0}, {0, 1, 0}, 1e-3f), 16, 16);
      const double one = 0.5 * 3 * r * r / (r * r + h * h);
      for (const char* method : {"raycast", "appel", "whitted", "distribution", "path"}) {
        const bool shadows = std::strcmp(method, "raycast") != 0;
        const double expected = shadows ? one : lights * one;
        const double mean = test::mean_of(test::rendered(with_integrator(d, method), 256)).value;
        EXPECT_NEAR(mean, expected, 3e-3 * expected) << method << ' ' << r << ' ' << lights;
      }
    }
}

// Without occluders shadows make no difference.
TEST(Classic, RaycastEqualsAppelWithoutOccluders) {
  scene::Scene scene;
  test::add(scene, test::quad(3), test::diffuse(Rgb(0.6f)));
  Mat4 above(1);
  above[1][1] = -1;
  above[2][2] = -1;
  above[3] = Vec4(0, 3, 0, 1);
  test::add(scene, test::quad(1), test::diffuse(Rgb(0), Rgb(6)), above);
  test::add_point_light(scene, {1, 2, 0}, 3);
  const auto d = test::document(scene, look_at({0, 2, 5}, {0, 0.4f, 0}, {0, 1, 0}, 0.8f), 32, 32);
  const auto lit = test::rendered(with_integrator(d, "raycast"), 8),
             shadowed = test::rendered(with_integrator(d, "appel"), 8);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(lit.mean(x, y)[c], shadowed.mean(x, y)[c], 1e-5f * lit.mean(x, y)[c]) << x << ' ' << y;
}

// The shadow of a ball on the floor is the intersection of the floor with the tangent cone of the ball. All other
// pixels equal those without shadows.
TEST(Appel, ShadowOfABallIsItsProjection) {
  const Vec3 light(0.5f, 3, 0), ball(0, 1, 0);
  constexpr float kRadius = 0.5f;
  scene::Scene scene;
  test::add(scene, test::quad(10), test::diffuse(Rgb(0.5f)));
  Mat4 place(1);
  place[3] = Vec4(ball, 1);
  test::add(scene, test::sphere(kRadius, 128, false), test::diffuse(Rgb(0)), place);
  test::add_point_light(scene, light, 5);
  constexpr int kSide = 64;
  auto d = test::document(scene, look_at({0, 3, 6}, {0, 0, 0}, {0, 1, 0}, 0.7f), kSide, kSide);
  d.filter = film::FilterKind::centre;
  const auto lit = test::rendered(with_integrator(d, "raycast"), 2),
             shadowed = test::rendered(with_integrator(d, "appel"), 2);
  const CameraRays camera(d.camera, kSide, kSide);
  int dark = 0, bright = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Ray ray = camera.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, {0.5f, 0.5f});
      const Vec3 floor = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
      const Vec3 up = light - floor;
      const float miss = glm::length(glm::cross(up, ball - floor)) / glm::length(up);
      const bool seen = glm::length(glm::cross(ray.direction, ball - ray.origin)) > 1.02f * kRadius;
      if (ray.direction.y >= 0 || !seen || std::abs(miss / kRadius - 1) < 0.02f) continue;
      const bool shadow = miss < kRadius;
      ++(shadow ? dark : bright);
      ASSERT_EQ(average(shadowed.mean(x, y)), shadow ? 0 : average(lit.mean(x, y))) << x << ' ' << y;
    }
  EXPECT_GT(dark, 50);
  EXPECT_GT(bright, 1000);
}

TEST(Appel, EqualsPathTracingOfDirectLight) {
  const auto cornell = test::cornell(test::kSize);
  for (const auto& d : {cornell, mirrors(false), mirrors(true)}) {
    const auto path = replicated(with(d, "film.paths", "E[D|G]L"), 128);
    for (const char* lights : {"one", "every"})
      expect_agreement(replicated(with(with_integrator(d, "appel"), "appel.lights", lights), 128, 2000), path, lights,
                       6);
  }
}

TEST(Whitted, EqualsPathTracingOfItsPathClasses) {
  const auto cornell = test::cornell(test::kSize);
  for (const auto& d : {cornell, mirrors(false), mirrors(true)}) {
    const auto path = replicated(with(d, "film.paths", "ES*[D|G]L"), 128);
    for (const char* lights : {"one", "every"}) {
      auto whitted = with(with(with_integrator(d, "whitted"), "whitted.lights", lights), "whitted.threshold", "1e-5");
      expect_agreement(replicated(whitted, 64, 2000), path, lights, 6);
    }
  }
}

// The integrator makes no random decision under point lights: another seed gives the same image, and both half-buffers
// are equal.
TEST(Whitted, HasNoNoiseUnderPointLights) {
  auto d = mirrors(true);
  d.filter = film::FilterKind::centre;
  d = with_integrator(d, "whitted");
  const auto one = test::rendered(d, 2);
  EXPECT_GT(test::mean_of(one).value, 0.01);
  d.seed = 12345;
  EXPECT_TRUE(same_bits(one, test::rendered(d, 2)));
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x) EXPECT_EQ(one.half_buffer_mean(x, y, 0), one.half_buffer_mean(x, y, 1));
}

// Between lossless mirrors of emission one, the radiance equals the number of edges.
TEST(Whitted, DepthCountsEdgesBetweenMirrors) {
  const auto hall = relit(test::document(test::furnace(1), look_at({0.1f, 0, 0}, {0.2f, 0.3f, 1}, {0, 1, 0}, 1), 8, 8),
                          [](scene::Scene& scene) {
                            Material& m = scene.materials[0];
                            m.base_color = Rgb(1);
                            m.metallic = 1;
                            m.roughness = 0;
                            m.specular = 1;
                          });
  for (const int depth : {1, 2, 5, 16, 100}) {
    const auto d = with(with_integrator(hall, "whitted"), "whitted.max-depth", std::to_string(depth));
    EXPECT_NEAR(test::mean_of(test::rendered(d, 2)).value, depth, 1e-4 * depth);
  }
}

// A glass sheet reflects a few per cent and transmits the remainder. Branches with a weight below the threshold are
// cut.
TEST(Whitted, BranchesBelowTheThresholdAreCut) {
  scene::Scene scene;
  Material glass;
  glass.metallic = 0;
  glass.roughness = 0;
  glass.transmission = 1;
  test::add(scene, test::quad(10), glass);
  scene.environment.tint = Rgb(1);
  const auto d = test::document(scene, look_at({0, 2, 0.01f}, {0, 0, 0}, {0, 1, 0}, 0.1f), 8, 8);
  const auto mean_radiance = [&](const char* threshold) {
    return test::mean_of(test::rendered(with(with_integrator(d, "whitted"), "whitted.threshold", threshold), 2)).value;
  };
  EXPECT_NEAR(mean_radiance("0.01"), 1, 1e-4);
  EXPECT_NEAR(mean_radiance("0.1"), 0.96, 1e-3);
  EXPECT_EQ(mean_radiance("1"), 0);
}

}  // namespace
}  // namespace etendue::classic_test
