// Lights of thesis 4.3 on a floor, against closed forms.          digest 4-5: items 79-83, 3.1 a h i j, 3.3 D; E30, E31
#include <gtest/gtest.h>

#include "support/places.h"

namespace etendue {
namespace {

using render::Document;
using test::Mean;

constexpr float kAlbedo = 0.5f;

// At the height, shining down; `tilt` turns it about x, in radians.
scene::Transform above(float height, float tilt = 0) {
  scene::Transform place;
  place.matrix = Mat4(1);
  const float c = std::cos(tilt), s = std::sin(tilt);
  auto& m = *place.matrix;
  m[1] = Vec4(0, s, -c, 0), m[2] = Vec4(0, c, s, 0), m[3] = Vec4(0, height, 0, 1);
  return place;
}

Light light_of(LightType type) {
  Light light;
  light.type = type;
  return light;
}

// The floor at the origin, through so narrow a view that it is all one point, and under all lamps.
Document point_of_floor(const Light& light, const scene::Transform& place, float scale = 1) {
  scene::Scene scene;
  test::add(scene, test::quad(20 * scale), test::diffuse(Rgb(kAlbedo)));
  test::add(scene, light, place);
  return test::document(std::move(scene), look_at(scale * Vec3(3, 0.3f, 1), Vec3(0), {0, 1, 0}, 1e-4f), 8, 8);
}

// Irradiance there: what a Lambertian floor shows times pi over its albedo.
Mean irradiance(const Document& d, uint32_t samples) {
  Mean mean = test::mean_of(test::rendered(d, samples));
  mean.value *= kPi / kAlbedo, mean.standard_error *= kPi / kAlbedo;
  return mean;
}

// Within four standard errors, and these are small.
void expect_irradiance(const Document& d, double expected, const std::string& what) {
  const Mean e = irradiance(test::with(test::by(d, "path"), "max-depth", "2"), 1024);
  EXPECT_NEAR(e.value, expected, 4 * e.standard_error + 1e-5 * expected) << what;
  EXPECT_LT(e.standard_error, 4e-3 * expected) << what;
}

TEST(SurfaceLight, DiskOverAParallelFloor) {
  for (const float scale : {1e-3f, 1.0f, 1e3f})
    for (const float height : {0.2f, 1.0f, 5.0f}) {
      Light disk = light_of(LightType::disk);
      disk.radius = scale;
      expect_irradiance(point_of_floor(disk, above(height * scale), scale), kPi / (1 + sqr(height)),
                        "height " + std::to_string(height));
    }
}

// A sphere shines as far as its distance alone says, near and far.
TEST(SurfaceLight, SphereOverAFloor) {
  for (const float scale : {1e-3f, 1.0f, 1e3f})
    for (const float height : {1.01f, 1.5f, 10.0f, 100.0f}) {
      Light sphere = light_of(LightType::sphere);
      sphere.radius = scale;
      expect_irradiance(point_of_floor(sphere, above(height * scale), scale), kPi / sqr(height),
                        "height " + std::to_string(height));
    }
}

TEST(SurfaceLight, QuadOverAParallelFloor) {
  for (const float height : {0.3f, 1.0f, 4.0f}) {
    Light quad = light_of(LightType::quad);
    quad.width = 2, quad.height = 3;
    const double x = 1.0 / static_cast<double>(height), y = 1.5 / static_cast<double>(height);
    const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
    expect_irradiance(point_of_floor(quad, above(height)), 2 * (x / a * std::atan(y / a) + y / b * std::atan(x / b)),
                      "height " + std::to_string(height));
  }
}

// The back of a light of one side is black, that of two is as bright.
TEST(SurfaceLight, ShinesFromTheSidesItHas) {
  for (const LightType type : {LightType::quad, LightType::disk}) {
    Light light = light_of(type);
    const auto turned = above(1, kPi);
    EXPECT_EQ(irradiance(test::by(point_of_floor(light, turned), "path"), 64).value, 0);
    light.two_sided = true;
    const Mean paths = irradiance(point_of_floor(light, above(1)), 256),
               back = irradiance(point_of_floor(light, turned), 256);
    EXPECT_NEAR(paths.value, back.value, 4 * std::hypot(paths.standard_error, back.standard_error));
    EXPECT_GT(back.value, 0.3);
  }
}

// The same light by its power as by its radiance.
TEST(SurfaceLight, PowerIsRadianceOverPiTheAreaAndTheSides) {
  for (const LightType type : {LightType::quad, LightType::disk, LightType::sphere})
    for (const bool two_sided : {false, true}) {
      Light light = light_of(type);
      light.two_sided = two_sided, light.width = 0.7f, light.height = 0.4f, light.radius = 0.3f;
      Light as_power = light;
      as_power.quantity = SurfaceQuantity::power;
      as_power.intensity = kPi * light.area() * static_cast<float>(light.sides());
      EXPECT_NEAR(as_power.radiance().r, light.radiance().r, 1e-6f);
    }
}

// L0 cos^k from a disk: E = 2 pi L0 (1 - cos^(k+2) of its edge) / (k + 2) on the axis; as points it is as bright.
TEST(SurfaceLight, FocusIsAPowerOfTheCosine) {
  for (const float focus : {0.0f, 1.0f, 6.5f}) {
    Light disk = light_of(LightType::disk);
    disk.radius = 1, disk.cosine_exponent = focus;
    const double edge = std::sqrt(0.5), k = static_cast<double>(focus);
    const double expected = 2 * static_cast<double>(kPi) * (1 - std::pow(edge, k + 2)) / (k + 2);
    expect_irradiance(point_of_floor(disk, above(1)), expected, "focus " + std::to_string(focus));
    disk.points = 400;
    const auto points = test::with(test::by(point_of_floor(disk, above(1)), "appel"), "appel.lights", "every");
    EXPECT_NEAR(irradiance(points, 4).value, expected, 1e-3 * expected);
    disk.points = 0;
    // Power is its integral over all directions.
    disk.quantity = SurfaceQuantity::power, disk.intensity = 2 * kPi * disk.area() / (focus + 2);
    EXPECT_NEAR(disk.radiance().r, 1, 1e-6f);
  }
}

// What a camera sees of it: its radiance, over just the directions that it fills.
TEST(SurfaceLight, IsSeenAsLargeAsItIs) {
  constexpr float kField = 1.2f, kDistance = 4;
  const double side = 2 * static_cast<double>(kDistance * std::tan(kField / 2));
  const auto share = [&](const Light& light) {
    scene::Scene scene;
    scene::Transform place;  // shines towards -z, where the camera is
    test::add(scene, light, place);
    auto d = test::document(std::move(scene), look_at({0, 0, -kDistance}, Vec3(0), {0, 1, 0}, kField), 48, 48);
    return test::mean_of(test::rendered(test::by(d, "path"), 64));
  };
  Light light = light_of(LightType::disk);
  light.radius = 1;
  Mean seen = share(light);
  EXPECT_NEAR(seen.value, static_cast<double>(kPi) / sqr(side), 4 * seen.standard_error + 1e-4);
  light.type = LightType::sphere;
  // Its outline is that of the disk where the cone touches it.
  seen = share(light);
  EXPECT_NEAR(seen.value, static_cast<double>(kPi) / sqr(side) / (1 - 1.0 / sqr(kDistance)),
              4 * seen.standard_error + 1e-4);
  light.type = LightType::quad, light.width = 2, light.height = 1;
  seen = share(light);
  EXPECT_NEAR(seen.value, 2 / sqr(side), 4 * seen.standard_error + 1e-4);
}

// On the axis of a disk as high as its radius, points on rings of equal area: the digest's errors, without noise.
TEST(SurfaceLight, AsPointsErrsAsTheirNumberSays) {
  const std::pair<int, double> kErrors[] = {
      {1, -1.745e-1}, {4, -1.399e-2}, {16, -8.935e-4}, {64, -5.59e-5}, {256, -3.5e-6}};
  for (const auto& [points, error] : kErrors) {
    Light disk = light_of(LightType::disk);
    disk.radius = 1, disk.points = points;
    const auto d = test::with(test::by(point_of_floor(disk, above(1)), "appel"), "appel.lights", "every");
    const Mean e = irradiance(d, 16);
    EXPECT_NEAR(e.value - static_cast<double>(kPi) / 2, error, 1e-3 * std::abs(error) + 2e-6) << points;
  }
}

// Many points are the surface.
TEST(SurfaceLight, AsManyPointsIsAsBright) {
  for (const LightType type : {LightType::quad, LightType::disk, LightType::sphere}) {
    Light light = light_of(type);
    light.width = 1.4f, light.height = 0.6f, light.radius = 0.4f, light.two_sided = true;
    const Document area = point_of_floor(light, above(1.2f, 0.5f));
    light.points = 400;
    const auto points =
        test::with(test::by(point_of_floor(light, above(1.2f, 0.5f)), "appel"), "appel.lights", "every");
    const Mean exact = irradiance(test::with(test::by(area, "path"), "max-depth", "2"), 1024);
    const double e = irradiance(points, 4).value;
    EXPECT_NEAR(e, exact.value, 4 * exact.standard_error + 2e-3 * exact.value) << static_cast<int>(type);
  }
}

// Ambient light C: a flat colour albedo C, through whatever stands in between.
TEST(AmbientLight, IsTheSameEverywhere) {
  Light ambient = light_of(LightType::ambient);
  ambient.intensity = 3;
  for (const float scale : {1e-3f, 1.0f, 1e4f}) {
    Document d = point_of_floor(ambient, above(1), scale);
    scene::Scene covered = *d.scene;
    test::add(covered, test::cube(0.5f * scale, false), test::diffuse(Rgb(0)));
    d.scene = std::make_shared<const scene::Scene>(std::move(covered));
    d.camera = look_at(scale * Vec3(0.3f, 0.4f, 0.2f), Vec3(0), {0, 1, 0}, 1e-4f);
    for (const char* method : {"path", "appel", "bdpt"}) {
      const Mean e = irradiance(test::with(test::by(d, method), "max-depth", "2"), 512);
      EXPECT_NEAR(e.value, 3 * static_cast<double>(kPi), 4 * e.standard_error) << method;
    }
  }
}

// ---- Lights without extent: no noise.

double sharp_irradiance(const Light& light, const scene::Transform& place) {
  return irradiance(test::with(test::by(point_of_floor(light, place), "appel"), "appel.lights", "every"), 4).value;
}

TEST(PointLight, FallsOffAsTheSquareOfTheDistance) {
  Light light = light_of(LightType::point);
  light.intensity = 3;
  for (const float height : {0.5f, 2.0f})
    EXPECT_NEAR(sharp_irradiance(light, above(height)), 3 / sqr(height), 1e-4 / sqr(height));
}

// Albedo 0.5, irradiance pi across the beam, 60 degrees: radiance 0.25.
TEST(DirectionalLight, CountsByTheCosine) {
  Light light = light_of(LightType::directional);
  light.intensity = kPi;
  EXPECT_NEAR(sharp_irradiance(light, above(1, kPi / 3)) * static_cast<double>(kAlbedo / kPi), 0.25, 1e-5);
}

TEST(SpotLight, ProfilesFallFromTheInnerConeToTheOuter) {
  Light point = light_of(LightType::point);
  const double whole = sharp_irradiance(point, above(2));
  for (const SpotProfile profile : {SpotProfile::squared, SpotProfile::smoothstep, SpotProfile::quartic}) {
    Light spot = light_of(LightType::spot);
    spot.profile = profile, spot.inner_cone = 0.3f, spot.outer_cone = 0.9f;
    EXPECT_NEAR(sharp_irradiance(spot, above(2, 0.29f)), whole, 1e-5);
    EXPECT_EQ(sharp_irradiance(spot, above(2, 0.91f)), 0);
    double before = whole;
    for (const float angle : {0.35f, 0.5f, 0.7f, 0.85f}) {
      const double now = sharp_irradiance(spot, above(2, angle));
      EXPECT_LT(now, before) << angle;
      EXPECT_GT(now, 0) << angle;
      before = now;
    }
    // t in the middle, linear in the cosine.
    const double t = (std::cos(0.6) - std::cos(0.9)) / (std::cos(0.3) - std::cos(0.9));
    const double expected = profile == SpotProfile::squared      ? t * t
                            : profile == SpotProfile::smoothstep ? t * t * (3 - 2 * t)
                                                                 : t * t * t * t;
    EXPECT_NEAR(sharp_irradiance(spot, above(2, 0.6f)) / whole, expected, 1e-4);
  }
}

TEST(SpotLight, CosineProfileIsAPowerOfTheCosine) {
  for (const float exponent : {0.0f, 1.0f, 7.5f}) {
    Light spot = light_of(LightType::spot);
    spot.profile = SpotProfile::cosine, spot.exponent = exponent, spot.outer_cone = kPi / 2;
    for (const float angle : {0.0f, 0.7f, 1.4f})
      EXPECT_NEAR(sharp_irradiance(spot, above(1, angle)), std::pow(std::cos(angle), exponent), 1e-4);
  }
}

TEST(SpotLight, HasAHardEdgeWhereTheConesAreOne) {
  Light spot = light_of(LightType::spot);
  spot.inner_cone = spot.outer_cone = 0.6f;
  EXPECT_NEAR(sharp_irradiance(spot, above(1, 0.597f)), 1, 1e-4);
  EXPECT_EQ(sharp_irradiance(spot, above(1, 0.603f)), 0);
}

}  // namespace
}  // namespace etendue
