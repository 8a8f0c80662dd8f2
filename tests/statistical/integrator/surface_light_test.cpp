// Irradiance of a floor under every type of light, against closed forms.                           [Lang, sec. 4.3]
#include <gtest/gtest.h>

#include "scene/compiled_scene.h"
#include "support/integrator_scenes.h"

namespace etendue::surface_light_test {
namespace {

using render::Document;
using test::Mean;

constexpr float kAlbedo = 0.5f;

// A transform at this height that emits downwards; `tilt` rotates the light about x, in radians.
scene::Transform above(float height, float tilt = 0) {
  scene::Transform place;
  place.matrix = Mat4(1);
  const float c = std::cos(tilt), s = std::sin(tilt);
  auto& m = *place.matrix;
  m[1] = Vec4(0, s, -c, 0);
  m[2] = Vec4(0, c, s, 0);
  m[3] = Vec4(0, height, 0, 1);
  return place;
}

// The floor at the origin, in such a narrow view that all pixels see the same point below the light.
Document point_of_floor(const Light& light, const scene::Transform& place, float scale = 1) {
  scene::Scene scene;
  test::add(scene, test::quad(20 * scale), test::diffuse(Rgb(kAlbedo)));
  test::add(scene, light, place);
  return test::document(std::move(scene), look_at(scale * Vec3(3, 0.3f, 1), Vec3(0), {0, 1, 0}, 1e-4f), 8, 8);
}

// Irradiance of the Lambertian floor: its radiance times pi / albedo.
Mean irradiance(const Document& d, uint32_t samples) {
  Mean mean = test::mean_of(test::rendered(d, samples));
  mean.value *= kPi / kAlbedo;
  mean.standard_error *= kPi / kAlbedo;
  return mean;
}

// Tolerance of four standard errors, which are at most 0.4 % of the value.
void expect_irradiance(const Document& d, double expected, const std::string& what) {
  const Mean e = irradiance(test::with(test::with_integrator(d, "path"), "max-depth", "2"), 1024);
  EXPECT_NEAR(e.value, expected, 4 * e.standard_error + 1e-5 * expected) << what;
  EXPECT_LT(e.standard_error, 4e-3 * expected) << what;
}

TEST(SurfaceLight, DiskOverAParallelFloor) {
  for (const float scale : {1e-3f, 1.0f, 1e3f})
    for (const float height : {0.2f, 1.0f, 5.0f}) {
      const Light disk = make_light("disk", {{"radius", double{scale}}});
      expect_irradiance(point_of_floor(disk, above(height * scale), scale), kPi / (1 + sqr(height)),
                        "height " + std::to_string(height));
    }
}

// The irradiance of a sphere depends only on the distance of its centre, near and far.
TEST(SurfaceLight, SphereOverAFloor) {
  for (const float scale : {1e-3f, 1.0f, 1e3f})
    for (const float height : {1.01f, 1.5f, 10.0f, 100.0f}) {
      const Light sphere = make_light("sphere", {{"radius", double{scale}}});
      expect_irradiance(point_of_floor(sphere, above(height * scale), scale), kPi / sqr(height),
                        "height " + std::to_string(height));
    }
}

TEST(SurfaceLight, QuadOverAParallelFloor) {
  for (const float height : {0.3f, 1.0f, 4.0f}) {
    const Light quad = make_light("quad", {{"width", 2.0}, {"height", 3.0}});
    const double x = 1.0 / static_cast<double>(height);
    const double y = 1.5 / static_cast<double>(height);
    const double a = std::sqrt(1 + x * x);
    const double b = std::sqrt(1 + y * y);
    expect_irradiance(point_of_floor(quad, above(height)), 2 * (x / a * std::atan(y / a) + y / b * std::atan(x / b)),
                      "height " + std::to_string(height));
  }
}

// The irradiance of a receiver that faces the middle of the axis of a cylinder, for radiance one. alpha is the angle
// across the axis, t the angle out of that plane, with the cosine cos alpha cos t and the solid angle cos t.
double cylinder_irradiance(double radius, double length, double distance) {
  const double edge = std::asin(radius / distance);
  constexpr int kSteps = 20'000;
  double sum = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double alpha = edge * (2 * (k + 0.5) / kSteps - 1);
    const double across = distance * std::cos(alpha) - std::sqrt(sqr(radius) - sqr(distance * std::sin(alpha)));
    const double t = std::atan(0.5 * length / across);
    sum += std::cos(alpha) * (t + std::sin(t) * std::cos(t)) * 2 * edge / kSteps;
  }
  return sum;
}

TEST(SurfaceLight, CylinderOverAParallelFloor) {
  EXPECT_NEAR(cylinder_irradiance(0.1, 1e6, 1), static_cast<double>(kPi) * 0.1, 1e-6) << "pi R / d of a long tube";
  for (const float scale : {1e-3f, 1.0f, 1e3f})
    for (const double height : {0.32, 1.0, 20.0}) {
      const Light tube = make_light("cylinder", {{"radius", 0.3 * double{scale}}, {"length", 2 * double{scale}}});
      expect_irradiance(point_of_floor(tube, above(static_cast<float>(height) * scale), scale),
                        cylinder_irradiance(0.3, 2, height), "height " + std::to_string(height));
    }
}

// The back of a one-sided light is black; that of a two-sided light has the radiance of its front.
TEST(SurfaceLight, EmitsFromItsSides) {
  for (const char* type : {"quad", "disk"}) {
    Light light = make_light(type);
    const auto turned = above(1, kPi);
    EXPECT_EQ(irradiance(test::with_integrator(point_of_floor(light, turned), "path"), 64).value, 0);
    light.set("two-sided", true);
    const Mean front = irradiance(point_of_floor(light, above(1)), 256);
    const Mean back = irradiance(point_of_floor(light, turned), 256);
    EXPECT_NEAR(front.value, back.value, 4 * std::hypot(front.standard_error, back.standard_error));
    EXPECT_GT(back.value, 0.3);
  }
}

// A disk with radiance L0 cos^k has the irradiance E = 2 pi L0 (1 - cos^(k+2) a) / (k + 2) on its axis, where a is the
// half-angle that it subtends. Point samples give the same irradiance.
TEST(SurfaceLight, RadianceIsAPowerOfTheCosine) {
  for (const double k : {0.0, 1.0, 6.5}) {
    Light disk = make_light("disk", {{"radius", 1.0}, {"focus", k}});
    const double edge = std::sqrt(0.5);
    const double expected = 2 * static_cast<double>(kPi) * (1 - std::pow(edge, k + 2)) / (k + 2);
    expect_irradiance(point_of_floor(disk, above(1)), expected, "cosine exponent " + std::to_string(k));
    disk.set("points", int64_t{400});
    const auto points =
        test::with(test::with_integrator(point_of_floor(disk, above(1)), "appel"), "appel.lights", "every");
    EXPECT_NEAR(irradiance(points, 4).value, expected, 1e-3 * expected);
  }
}

// A mesh above the floor: a rectangle whose texture is white, beside one whose texture is black. The point of the floor is
// below the corner of the white one.
Document floor_below_texture(float height) {
  auto mesh = std::make_shared<Mesh>();
  for (const float side : {-1.0f, 1.0f}) {
    const auto first = static_cast<uint32_t>(mesh->positions.size());
    for (const Vec2 corner : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1.5f), Vec2(0, 1.5f)}) {
      mesh->positions.emplace_back(side * corner.x, height, corner.y);
      mesh->uvs[0].emplace_back(side < 0 ? 0.25f : 0.75f, 0.5f);
    }
    mesh->triangles.push_back({first, first + 1, first + 2});
    mesh->triangles.push_back({first, first + 2, first + 3});
  }
  auto texels = std::make_shared<image::Image>();
  texels->width = 2;
  texels->height = 1;
  texels->channels = 3;
  texels->bytes = {0, 0, 0, 255, 255, 255};
  scene::Scene scene;
  scene.textures.emplace_back().image = texels;
  Material emitter = test::diffuse(Rgb(0), Rgb(1));
  emitter.emission_texture.texture = 0;
  emitter.double_sided = true;
  test::add(scene, test::quad(20), test::diffuse(Rgb(kAlbedo)));
  test::add(scene, mesh, emitter);
  return test::document(std::move(scene), look_at({3, 0.1f, -1}, Vec3(0), {0, 1, 0}, 1e-4f), 8, 8);
}

// Triangles whose texture is black are no lights, and the others keep their numbers.
TEST(SurfaceLight, TexturedMeshThatIsPartlyBlack) {
  constexpr float kHeight = 0.7f;
  const Document d = floor_below_texture(kHeight);
  const auto compiled = scene::compile(d.scene, d.camera, nullptr);
  ASSERT_EQ(compiled->lights().triangles().size(), 2U);
  const double x = 1 / double{kHeight}, y = 1.5 / double{kHeight}, a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  const double expected = 0.5 * (x / a * std::atan(y / a) + y / b * std::atan(x / b));
  expect_irradiance(d, expected, "path");
  const Mean pure = irradiance(test::with(test::with_integrator(d, "path-pure"), "max-depth", "2"), 16384);
  EXPECT_NEAR(pure.value, expected, 4 * pure.standard_error);
  EXPECT_LT(pure.standard_error, 0.02 * expected);
}

// In a wider view, where light subpaths reach the camera.
TEST(SurfaceLight, TexturedMeshThatIsPartlyBlackFromItsSide) {
  Document d = floor_below_texture(0.7f);
  d.width = d.height = test::kSize;
  d.camera = look_at({3, 1, -2}, Vec3(0, 0.3f, 0.5f), {0, 1, 0}, 1);
  const test::Estimate path = test::replicated(test::with_integrator(d, "path"), 64);
  const test::Estimate light = test::replicated(test::with_integrator(d, "light"), 256, 2000);
  const test::Estimate both = test::replicated(test::with_integrator(d, "bdpt"), 64, 3000);
  test::expect_agreement(path, light, "path and light", 3);
  test::expect_agreement(path, both, "path and bdpt", 3);
  test::expect_agreement(light, both, "light and bdpt", 3);
}

// A texture that is bright at none of the points of the mean: its triangles are no lights, but paths still hit them.
TEST(SurfaceLight, TextureThatTheMeanMisses) {
  Document d = floor_below_texture(0.7f);
  scene::Scene scene = *d.scene;
  auto texels = std::make_shared<image::Image>();
  texels->width = texels->height = 32;
  texels->channels = 3;
  texels->bytes.assign(size_t{3} * 32 * 32, 0);
  for (int y = 6; y < 9; ++y)
    for (int x = 6; x < 9; ++x)
      for (int c = 0; c < 3; ++c) texels->bytes[static_cast<size_t>(3 * (32 * y + x) + c)] = 255;
  scene.textures[0].image = texels;
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{-2, 0.7f, -2}, {2, 0.7f, -2}, {-2, 0.7f, 2}};
  mesh->uvs[0] = {{0, 0}, {1, 0}, {0, 1}};
  mesh->triangles = {{0, 1, 2}};
  test::add(scene, mesh, scene.materials.back());
  scene.nodes[1].visible = false;
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  d.width = d.height = test::kSize;
  d.camera = look_at({3, 0.5f, -2}, Vec3(0), {0, 1, 0}, 1);
  ASSERT_TRUE(scene::compile(d.scene, d.camera, nullptr)->lights().triangles().empty());
  const test::Estimate pure = test::replicated(test::with_integrator(d, "path-pure"), 4096);
  const test::Estimate path = test::replicated(test::with_integrator(d, "path"), 4096, 2000);
  const test::Estimate both = test::replicated(test::with_integrator(d, "bdpt"), 4096, 3000);
  test::expect_agreement(pure, path, "path-pure and path", 2);
  test::expect_agreement(pure, both, "path-pure and bdpt", 2);
  double mean = 0, variance = 0;
  for (size_t i = 0; i < pure.mean.size(); ++i) mean += pure.mean[i], variance += pure.variance[i];
  EXPECT_GT(mean, 0);
  EXPECT_LT(std::sqrt(variance), 0.1 * mean);
}

// The camera sees the radiance of the light over the solid angle that the light subtends.
TEST(SurfaceLight, CoversItsSolidAngle) {
  constexpr float kField = 1.2f, kDistance = 4;
  const double side = 2 * static_cast<double>(kDistance * std::tan(kField / 2));
  const auto share = [&](const Light& light) {
    scene::Scene scene;
    scene::Transform place;  // emits towards -z, where the camera is
    test::add(scene, light, place);
    auto d = test::document(std::move(scene), look_at({0, 0, -kDistance}, Vec3(0), {0, 1, 0}, kField), 48, 48);
    return test::mean_of(test::rendered(test::with_integrator(d, "path"), 64));
  };
  Mean seen = share(make_light("disk", {{"radius", 1.0}}));
  EXPECT_NEAR(seen.value, static_cast<double>(kPi) / sqr(side), 4 * seen.standard_error + 1e-4);
  // The outline is the circle where the cone of view rays touches the sphere.
  seen = share(make_light("sphere", {{"radius", 1.0}}));
  EXPECT_NEAR(seen.value, static_cast<double>(kPi) / sqr(side) / (1 - 1.0 / sqr(kDistance)),
              4 * seen.standard_error + 1e-4);
  seen = share(make_light("quad", {{"width", 2.0}, {"height", 1.0}}));
  EXPECT_NEAR(seen.value, 2 / sqr(side), 4 * seen.standard_error + 1e-4);
}

// Point samples on rings of equal area, on the axis of a disk at a height equal to its radius: the errors have a closed
// form and no noise.
TEST(SurfaceLight, ErrorOfPointSamplesDependsOnTheirNumber) {
  const std::pair<int, double> kErrors[] = {
      {1, -1.745e-1}, {4, -1.399e-2}, {16, -8.935e-4}, {64, -5.59e-5}, {256, -3.5e-6}};
  for (const auto& [points, error] : kErrors) {
    const Light disk = make_light("disk", {{"radius", 1.0}, {"points", points}});
    const auto d = test::with(test::with_integrator(point_of_floor(disk, above(1)), "appel"), "appel.lights", "every");
    const Mean e = irradiance(d, 16);
    EXPECT_NEAR(e.value - static_cast<double>(kPi) / 2, error, 1e-3 * std::abs(error) + 2e-6) << points;
  }
}

// The irradiance of many point samples converges to that of the surface.
TEST(SurfaceLight, ManyPointSamplesConvergeToTheSurface) {
  for (const char* type : {"quad", "disk", "sphere"}) {
    Light light = make_light(type);
    for (const auto& [size, value] : {std::pair("width", 1.4), std::pair("height", 0.6), std::pair("radius", 0.4)})
      light.set(size, value);
    light.set("two-sided", true);
    const Document area = point_of_floor(light, above(1.2f, 0.5f));
    light.set("points", int64_t{400});
    const auto points =
        test::with(test::with_integrator(point_of_floor(light, above(1.2f, 0.5f)), "appel"), "appel.lights", "every");
    const Mean exact = irradiance(test::with(test::with_integrator(area, "path"), "max-depth", "2"), 1024);
    const double e = irradiance(points, 4).value;
    EXPECT_NEAR(e, exact.value, 4 * exact.standard_error + 2e-3 * exact.value) << type;
  }
}

// Ambient light of radiance C: a Lambertian surface reflects albedo C, regardless of occluders.
TEST(AmbientLight, IsIndependentOfOccluders) {
  const Light ambient = make_light("ambient", {{"intensity", 3.0}});
  for (const float scale : {1e-3f, 1.0f, 1e4f}) {
    Document d = point_of_floor(ambient, above(1), scale);
    scene::Scene covered = *d.scene;
    test::add(covered, test::cube(0.5f * scale, false), test::diffuse(Rgb(0)));
    d.scene = std::make_shared<const scene::Scene>(std::move(covered));
    d.camera = look_at(scale * Vec3(0.3f, 0.4f, 0.2f), Vec3(0), {0, 1, 0}, 1e-4f);
    for (const char* method : {"path", "appel", "bdpt"}) {
      const Mean e = irradiance(test::with(test::with_integrator(d, method), "max-depth", "2"), 512);
      EXPECT_NEAR(e.value, 3 * static_cast<double>(kPi), 4 * e.standard_error) << method;
    }
  }
}

// ---- Delta lights, without noise.

double sharp_irradiance(const Light& light, const scene::Transform& place) {
  return irradiance(test::with(test::with_integrator(point_of_floor(light, place), "appel"), "appel.lights", "every"),
                    4)
      .value;
}

TEST(PointLight, FallsOffAsTheSquareOfTheDistance) {
  const Light light = make_light("point", {{"intensity", 3.0}});
  for (const float height : {0.5f, 2.0f})
    EXPECT_NEAR(sharp_irradiance(light, above(height)), 3 / sqr(height), 1e-4 / sqr(height));
}

// Albedo 0.5 and irradiance pi across the beam at 60 degrees: radiance 0.25.
TEST(DirectionalLight, IrradianceHasTheCosine) {
  const Light light = make_light("directional", {{"intensity", double{kPi}}});
  EXPECT_NEAR(sharp_irradiance(light, above(1, kPi / 3)) * static_cast<double>(kAlbedo / kPi), 0.25, 1e-5);
}

TEST(SpotLight, ProfilesFallFromTheInnerToTheOuterCone) {
  const Light point = make_light("point");
  const double whole = sharp_irradiance(point, above(2));
  for (const char* profile : {"squared", "smoothstep", "quartic"}) {
    const Light spot = make_light("spot", {{"profile", profile}, {"inner-cone", 0.3}, {"outer-cone", 0.9}});
    EXPECT_NEAR(sharp_irradiance(spot, above(2, 0.29f)), whole, 1e-5);
    EXPECT_EQ(sharp_irradiance(spot, above(2, 0.91f)), 0);
    double before = whole;
    for (const float angle : {0.35f, 0.5f, 0.7f, 0.85f}) {
      const double now = sharp_irradiance(spot, above(2, angle));
      EXPECT_LT(now, before) << angle;
      EXPECT_GT(now, 0) << angle;
      before = now;
    }
    // Between the cones t is linear in the cosine.
    const double t = (std::cos(0.6) - std::cos(0.9)) / (std::cos(0.3) - std::cos(0.9));
    const double expected = std::string(profile) == "squared"      ? t * t
                            : std::string(profile) == "smoothstep" ? t * t * (3 - 2 * t)
                                                                   : t * t * t * t;
    EXPECT_NEAR(sharp_irradiance(spot, above(2, 0.6f)) / whole, expected, 1e-4);
  }
}

TEST(SpotLight, CosineProfileIsAPowerOfTheCosine) {
  for (const double exponent : {0.0, 1.0, 7.5}) {
    const Light spot =
        make_light("spot", {{"profile", "cosine"}, {"exponent", exponent}, {"outer-cone", double{kPi} / 2}});
    for (const float angle : {0.0f, 0.7f, 1.4f})
      EXPECT_NEAR(sharp_irradiance(spot, above(1, angle)), std::pow(std::cos(angle), exponent), 1e-4);
  }
}

TEST(SpotLight, EqualConesHaveAHardEdge) {
  const Light spot = make_light("spot", {{"inner-cone", 0.6}, {"outer-cone", 0.6}});
  EXPECT_NEAR(sharp_irradiance(spot, above(1, 0.597f)), 1, 1e-4);
  EXPECT_EQ(sharp_irradiance(spot, above(1, 0.603f)), 0);
}

}  // namespace
}  // namespace etendue::surface_light_test
