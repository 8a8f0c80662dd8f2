// The light meter in scenes with closed-form irradiance and radiance.
#include "render/light_meter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/bsdf_model.h"
#include "scene/builtin/shapes.h"
#include "scene/compiled_scene.h"
#include "spectrum/photometry.h"

namespace etendue::render {
namespace {

// A floor of albedo 1/2 in the xz plane, with the camera above its centre.
Document over_floor(scene::Scene scene) {
  scene::add(scene, scene::quad(20), scene::diffuse(Rgb(0.5f)));
  Document d;
  d.scene = std::make_shared<scene::Scene>(std::move(scene));
  d.camera = look_at({1, 0.9f, 1}, {0, 0, 0}, {0, 1, 0}, 0.5f);
  d.width = d.height = 64;
  return d;
}

MeterReadings read(const Document& d, uint32_t samples = 512, float sensor_size = 0) {
  const auto scene = scene::compile(d.scene, d.camera, nullptr);
  const auto spot = meter_point_at(d, *scene, Vec2(32));
  EXPECT_TRUE(spot);
  MeterReadings last;
  measure_light(d, scene, *spot, {samples, 1, sensor_size}, [&](const MeterReadings& m) { return last = m, true; });
  return last;
}

void expect(const MeterReading& r, double value) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(static_cast<double>(r.value[c]), value, 5 * r.standard_error + 2e-4 * value) << r.standard_error;
}

// Phi = 100 W at two metres: E = Phi / (4 pi r^2), L = rho E / pi [Lang, Example 4.2].
TEST(Meter, UnderAPointLight) {
  scene::Scene scene;
  const Light lamp = make_light("point", {{"intensity", 100 / (4 * 3.14159265358979)}});
  scene::add(scene, lamp, {.translation = {0, 2, 0}});
  const auto m = read(over_floor(std::move(scene)));
  expect(m.irradiance, 1.989437);
  expect(m.radiance, 0.316629);
}

// E = pi L R^2 / (R^2 + h^2) on the axis of a disk [Lang, eq. 10.81]. The flux of the disk is pi L times its area.
TEST(Meter, UnderADisk) {
  scene::Scene scene;
  Material lamp = scene::diffuse(Rgb(0), Rgb(3));
  lamp.double_sided = false;
  Mat4 down(1);
  down[1] = Vec4(0, -1, 0, 0);
  down[2] = Vec4(0, 0, -1, 0);
  down[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::disk(1, 256), lamp, down);
  Document d = over_floor(std::move(scene));
  const auto m = read(d, 2048);
  expect(m.irradiance, 3 * 1.570796);
  d.camera = look_at({1, 0.2f, 1}, {0, 1, 0}, {0, 1, 0}, 0.3f);
  EXPECT_NEAR(static_cast<double>(read(d, 4).emitted_flux.g), 3 * 3.14159265 * 3.14159265, 2e-3);
}

// A point light of 10 cd and its image in a vertical mirror: E = I h (1 / h^3 + 1 / (h^2 + 4 a^2)^(3/2)) with the light at
// height h above the point and the mirror at the distance a. Path tracing finds the first term only.
TEST(Meter, ContainsCausticsOfPointLights) {
  scene::Scene scene;
  scene::add(scene, make_light("point", {{"intensity", 10.0}}), {.translation = {0, 1, 0}});
  Material mirror = scene::diffuse(Rgb(1));
  mirror.model.model = make_bsdf_model("mirror");
  scene::add(scene, scene::rectangle({0.5f, 0, -10}, {0, 0, 20}, {0, 10, 0}), mirror);
  Document d = over_floor(std::move(scene));
  d.camera = look_at({-1, 0.9f, 1}, {0, 0, 0}, {0, 1, 0}, 0.5f);
  const auto m = read(d, 512);
  const double reflected = 10 / std::pow(2.0, 1.5), value = 10 + reflected;
  EXPECT_NEAR(static_cast<double>(m.irradiance.value.g), value, 5 * m.irradiance.standard_error + 0.02 * reflected);
  EXPECT_LT(m.irradiance.standard_error, 0.1 * reflected);
  EXPECT_NEAR(static_cast<double>(m.radiance.value.g), 0.5 * value / 3.14159265,
              5 * m.radiance.standard_error + 0.02 * reflected);
  EXPECT_LT(m.radiance.standard_error, 0.02 * reflected);
}

// The exitance of a disk of radiance 3 is 3 pi; a point light of 5 cd at 2 m has this intensity towards the floor.
TEST(Meter, ExitanceAndIntensities) {
  scene::Scene scene;
  scene::add(scene, make_light("point", {{"intensity", 5.0}}), {.translation = {0, 2, 0}});
  scene.lights.back().name = "bulb";
  const auto m = read(over_floor(std::move(scene)), 4);
  ASSERT_EQ(m.lights.size(), 1U);
  EXPECT_EQ(m.lights[0].name, "bulb");
  EXPECT_NEAR(m.lights[0].intensity.g, 5, 1e-4);
  EXPECT_NEAR(m.lights[0].distance, 2, 1e-4);
  EXPECT_EQ(m.emitted_exitance, Rgb(0));

  scene::Scene lit;
  Document d = over_floor(std::move(lit));
  auto emitting = std::make_shared<scene::Scene>(*d.scene);
  emitting->materials.back() = scene::diffuse(Rgb(0), Rgb(3));
  d.scene = emitting;
  EXPECT_NEAR(static_cast<double>(read(d, 4).emitted_exitance.g), 3 * 3.14159265, 1e-3);
}

// A uniform sky of radiance one sends the flux pi A to a square on the floor.
TEST(Meter, SquareReceivesFlux) {
  scene::Scene scene;
  scene.environment.tint = Rgb(1);
  const Document d = over_floor(std::move(scene));
  const auto m = read(d, 64, 1.5f);
  ASSERT_TRUE(m.received_flux);
  expect(*m.received_flux, 2.25 * 3.14159265);
  EXPECT_FALSE(read(d, 4).received_flux);

  // Around the point, and counter-clockwise as seen from the camera.
  const auto corners = sensor_corners(m.point, 1.5f);
  const Vec3 area = glm::cross(corners[1] - corners[0], corners[3] - corners[0]);
  EXPECT_NEAR(glm::dot(area, m.point.normal), 2.25f, 1e-5f);
  EXPECT_LT(glm::distance(0.5f * (corners[0] + corners[2]), m.point.position), 1e-5f);
}

// A constant environment of radiance one has irradiance pi on a floor without occluders.
TEST(Meter, UnderASky) {
  scene::Scene scene;
  scene.environment.tint = Rgb(1);
  const auto m = read(over_floor(std::move(scene)));
  expect(m.irradiance, 3.14159265);
  expect(m.radiance, 0.5);
}

// The probe is scaled with the scene: it is as accurate in a scene of the size of a coin as in one of many kilometres.
TEST(Meter, IsIndependentOfTheSceneScale) {
  for (const float size : {1e-3f, 1e5f}) {
    scene::Scene scene;
    scene.environment.tint = Rgb(1);
    scene::add(scene, scene::quad(size), scene::diffuse(Rgb(0.5f)));
    Document d;
    d.scene = std::make_shared<scene::Scene>(std::move(scene));
    d.camera = look_at(Vec3(0.1f, 0.09f, 0.1f) * size, {0, 0, 0}, {0, 1, 0}, 0.5f);
    d.width = d.height = 64;
    expect(read(d, 64).irradiance, 3.14159265);
  }
}

TEST(Meter, BackgroundHasNoReadings) {
  Document d = over_floor({});
  d.camera = look_at({0, 1, 0}, {0, 2, 0.1f}, {0, 0, 1}, 0.5f);
  EXPECT_FALSE(meter_point_at(d, *scene::compile(d.scene, d.camera, nullptr), Vec2(32)));
}

// The meter reports the flux 2 pi A L / (k + 2) of every area light with cosine exponent k.
TEST(Meter, FluxOfAreaLightsWithACosineExponent) {
  for (const LightTypeInfo& type : light_type_infos()) {
    if (type.description.light_class != LightClass::area) continue;
    const Light light = make_light(type.description.name, {{"intensity", 2.0}, {"focus", 6.0}});
    // A light facing up towards the camera, above the floor.
    scene::Scene scene;
    scene::add(scene, light, {.translation = {0, 1, 0}, .rotation = {std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)}});
    Document d = over_floor(std::move(scene));
    d.camera = look_at({0.3f, 4, 0.3f}, {0, 1, 0}, {0, 0, 1}, 0.1f);
    const auto expected = static_cast<double>(light.flux().g);
    EXPECT_NEAR(static_cast<double>(read(d, 4).emitted_flux.g), expected, 1e-3 * expected) << type.description.name;
  }
}

// A constant spectral radiance C over 300 to 800 nm has the luminance 683 * 107 C [Lang, table 3.2].
TEST(Photometry, Efficacies) {
  EXPECT_NEAR(lumens_per_watt(Efficacy::equal_energy) * 500, 73081, 0.5);
  EXPECT_NEAR(radiometric(1366, Efficacy::maximal), 2, 1e-12);
}

}  // namespace
}  // namespace etendue::render
