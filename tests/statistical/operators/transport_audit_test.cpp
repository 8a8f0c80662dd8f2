// The audits of light transport against closed forms: where the light of a scene goes, and the importance of its places.
//
// Means are compared within 4.5 standard errors, which are bounded.
#include "render/transport_audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bsdf/bsdf_model.h"
#include "scene/compiled_scene.h"
#include "support/integrator_scenes.h"
#include "support/scattering_scenes.h"

namespace etendue::transport_audit {
namespace {

using render::Document;
using render::EnergyAudit;
using render::Measured;

constexpr double kStandardErrors = 4.5;
constexpr uint64_t kPaths = 65'536;

Document seen(scene::Scene scene, const Vec3& eye = {0.3f, 0.2f, 0.1f}) {
  return test::document(std::move(scene), look_at(eye, {0, 0, 0}, {0, 1, 0}, 1), 16, 16);
}

EnergyAudit audit(const Document& d, uint64_t paths = kPaths) {
  const auto result = render::audit_energy(d, scene::compile(d.scene, d.camera, nullptr), paths, 2);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? *result : EnergyAudit{};
}

void expect_value(const Measured& m, double expected, const char* what, double largest_error = 0.01) {
  EXPECT_NEAR(m.value, expected, kStandardErrors * m.standard_error + 1e-4 * expected) << what;
  EXPECT_LE(m.standard_error, largest_error * std::max(expected, 1e-3)) << what;
}

// The furnace, which emits inwards only.
scene::Scene furnace(float albedo) {
  scene::Scene scene = test::furnace(albedo);
  scene.materials[0].double_sided = false;
  return scene;
}

// A closed cube of side 2 with radiance 1: it emits pi times 24 m^2, receives 1 / (1 - albedo) of that, and absorbs what
// it emits.
TEST(EnergyAudit, Furnace) {
  for (const float albedo : {0.0f, 0.5f, 0.8f}) {
    const EnergyAudit e = audit(seen(furnace(albedo)));
    const double emitted = kPi * 24;
    ASSERT_EQ(e.objects.size(), 1U);
    expect_value(e.emitted, emitted, "emitted");
    expect_value(e.objects[0].received, emitted / (1 - double{albedo}), "received", 0.02);
    expect_value(e.absorbed, emitted, "absorbed", 0.02);
    EXPECT_NEAR(e.objects[0].largest_albedo, double{albedo}, 1e-4);
    EXPECT_EQ(e.escaped.value, 0);
    EXPECT_TRUE(e.warnings.empty()) << e.warnings[0];
  }
}

// A box with five black walls and a floor that emits: the open side lets the form factor between opposite squares escape.
TEST(EnergyAudit, OpenBox) {
  scene::Scene scene;
  const Material black = test::diffuse(Rgb(0));
  const auto wall = [&](const Vec3& corner, const Vec3& u, const Vec3& v, const Material& material) {
    add(scene, scene::rectangle(corner, u, v), material);
  };
  Material light = test::diffuse(Rgb(0), Rgb(2));
  light.double_sided = false;
  wall({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, light);
  wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, black);
  wall({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, black);
  wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, black);
  wall({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, black);
  const EnergyAudit e = audit(seen(std::move(scene), {0.4f, 0.5f, 0.6f}));
  constexpr double kOpposite = 0.1998248957, kAdjacent = 0.2000437761;  // of the unit cube [Lang, ch. 10]
  const double emitted = 2 * kPi;
  expect_value(e.emitted, emitted, "emitted");
  expect_value(e.escaped, emitted * kOpposite, "escaped");
  for (const auto& object : e.objects)
    if (object.emitted.value == 0) expect_value(object.absorbed, emitted * kAdjacent, "wall");
  EXPECT_TRUE(e.warnings.empty());
}

// What a light with a range emits past all surfaces is removed by its range and does not leave the scene.
TEST(EnergyAudit, NothingEscapesBeyondTheRange) {
  scene::Scene scene;
  test::add_point_light(scene, {0, 0, 0}, 3);
  scene.lights.back().set("range", 2.0);
  add(scene, scene::rectangle({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}), test::diffuse(Rgb(0)));
  const EnergyAudit e = audit(seen(std::move(scene)));
  const double emitted = 4 * kPi * 3;
  expect_value(e.emitted, emitted, "emitted");
  EXPECT_EQ(e.escaped.value, 0);
  EXPECT_GT(e.beyond_range.value, 0.8 * emitted) << "the square covers a sixth of the directions";
  EXPECT_NEAR(e.missing.value, 0, kStandardErrors * e.missing.standard_error + 1e-4 * emitted);
}

// A point light in the centre of a ball of fog that absorbs, in a black sphere.
TEST(EnergyAudit, AbsorbingMedium) {
  scene::Scene scene;
  add_point_light(scene, Vec3(0), 3);
  add(scene, test::sphere(1, 96, false), test::medium_boundary(test::medium(Rgb(0), Rgb(0.7f))));
  add(scene, test::sphere(2, 96, true), test::diffuse(Rgb(0)));
  const EnergyAudit e = audit(seen(std::move(scene)));
  const double emitted = 4 * kPi * 3;
  expect_value(e.emitted, emitted, "emitted");
  // The ball is a polyhedron, slightly smaller than the sphere.
  EXPECT_NEAR(e.absorbed_by_media.value, emitted * -std::expm1(-0.7), 2e-3 * emitted);
  EXPECT_NEAR(e.absorbed.value, emitted * std::exp(-0.7), 2e-3 * emitted);
  EXPECT_NEAR(e.missing.value, 0, kStandardErrors * e.missing.standard_error + 1e-4 * emitted);
}

// Scattering media, glass and several kinds of lights: the balance holds.
TEST(EnergyAudit, BalanceOfScenes) {
  for (const Document& d : {test::glossy_scene(), test::balls_under_analytic_lights(), test::balls_under_sky(),
                            test::foggy_cornell_box(), test::stone_in_murky_water(), test::bsdf_model_scene()}) {
    const EnergyAudit e = audit(d, 131'072);
    EXPECT_NEAR(e.missing.value, 0, kStandardErrors * e.missing.standard_error + 1e-4 * e.emitted.value);
    EXPECT_LT(e.missing.standard_error, 0.02 * e.emitted.value);
    EXPECT_GT(e.absorbed.value, 0);
  }
}

// A surface that reflects more than it receives is named. The albedo of this model is 2.09 at normal incidence.
TEST(EnergyAudit, CreationOfEnergyIsReported) {
  scene::Scene scene;
  add_point_light(scene, {0, 0.5f, 0}, 3);
  Material shiny = test::diffuse(Rgb(0));
  shiny.model.model = make_bsdf_model("reciprocal-phong");
  for (const char* band : {"specular.r", "specular.g", "specular.b"})
    shiny.model.model = shiny.model.model->with(band, 1.0);
  shiny.model.model = shiny.model.model->with("exponent", 1.0);
  scene.nodes[static_cast<size_t>(add(scene, test::quad(1), shiny))].name = "plate";
  add(scene, test::sphere(4, 32, true), test::diffuse(Rgb(0)));
  const EnergyAudit e = audit(seen(std::move(scene), {1, 1, 1}));
  ASSERT_EQ(e.warnings.size(), 1U);
  EXPECT_NE(e.warnings[0].find("'plate' creates energy"), std::string::npos) << e.warnings[0];
  const auto plate = std::ranges::find_if(e.objects, [](const auto& object) { return object.name == "plate"; });
  ASSERT_NE(plate, e.objects.end());
  EXPECT_TRUE(plate->creates_energy);
  EXPECT_GT(plate->largest_albedo, 1.1);
  EXPECT_LT(plate->largest_albedo, 2.1);
}

// Light between white walls stays.
TEST(EnergyAudit, LightThatStaysIsReported) {
  const EnergyAudit e = audit(seen(furnace(1)), 256);
  EXPECT_NEAR(e.objects[0].absorbed.value, 0, 1e-3 * e.emitted.value);
  ASSERT_EQ(e.warnings.size(), 1U);
  EXPECT_NE(e.warnings[0].find("stays in the scene"), std::string::npos) << e.warnings[0];
}

TEST(EnergyAudit, ASceneWithoutLightIsAnError) {
  scene::Scene scene;
  add(scene, test::quad(1), test::diffuse(Rgb(0.5f)));
  const Document d = seen(std::move(scene), {0, 1, 2});
  const auto result = render::audit_energy(d, scene::compile(d.scene, d.camera, nullptr), kPaths, 1);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("add a light"), std::string::npos);
}

render::ImportanceAudit importance(const Document& d, uint32_t samples, float radius = 0) {
  const auto result =
      render::audit_importance(d, scene::compile(d.scene, d.camera, nullptr), d.camera, samples, radius, 2);
  EXPECT_TRUE(result);
  return result ? *result : render::ImportanceAudit{};
}

// Every path of a furnace has the throughput albedo^n at its vertex n: the sum is 1 / (1 - albedo).
TEST(ImportanceAudit, Furnace) {
  const auto a = importance(seen(test::furnace(0.5f)), 64);
  ASSERT_EQ(a.objects.size(), 1U);
  EXPECT_NEAR(a.objects[0].importance.value, 2, std::max(4.5 * a.objects[0].importance.standard_error, 1e-3));
}

// The mean of the image is the sum of importance times emission: the adjoint of the image.
TEST(ImportanceAudit, IsTheAdjointOfTheImage) {
  const Document d = test::balls_under_area_light();
  const auto a = importance(d, 4096);
  const film::Film film = test::rendered(d, 1024);
  const double image = double{luminance(test::mean_color(film))};
  const auto mean = test::mean_of(film);
  const auto& nodes = d.scene->nodes;
  double sum = 0, error = 0;
  for (const auto& object : a.objects) {
    // The light is the object that emits, from its front, with a radiance of 6.
    const int mesh = nodes[object.node].mesh;
    if (mesh < 0) continue;
    for (const auto& primitive : d.scene->meshes[static_cast<size_t>(mesh)].primitives) {
      const Material& material = d.scene->materials[static_cast<size_t>(primitive.material)];
      const double emission = double{luminance(material.emission)};
      sum += object.importance.value * emission;
      error += object.importance.standard_error * emission;
    }
  }
  EXPECT_NEAR(sum, image, kStandardErrors * (error + mean.standard_error / mean.value * image));
  EXPECT_LT(error, 0.03 * image);
}

// A camera above a black plane: the density of the image on the plane is one over the area that the image shows.
TEST(ImportanceAudit, DensityOnAPlane) {
  scene::Scene scene;
  add(scene, test::quad(20), test::diffuse(Rgb(0)));
  Document d = test::document(std::move(scene), look_at({0, 3, 0}, {0, 0, 0}, {0, 0, 1}, 0.6f), 32, 32);
  const auto a = importance(d, 256, 0.2f);
  const double area = std::pow(2 * 3 * std::tan(0.3), 2);
  double sum = 0;
  int count = 0;
  for (int y = 10; y < 22; ++y)
    for (int x = 10; x < 22; ++x, ++count) sum += double{a.picture.pixels[static_cast<size_t>(y * 32 + x)]};
  EXPECT_NEAR(sum / count, 1 / area, 0.01 / area);
}

}  // namespace
}  // namespace etendue::transport_audit
