// Scattering media against closed forms: Beer's law, single scattering, white furnaces, the transmittance of a slab.
//
// Means are compared within 4.5 standard errors, which are bounded: one false alarm in 150,000 comparisons of normal
// means.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "statistical/media/expected_radiance.h"
#include "stress/test_context.h"
#include "support/integrator_scenes.h"
#include "support/scattering_scenes.h"
#include "support/translation.h"

namespace etendue {
namespace {

using render::Document;
using test::at;
using test::expect_radiance;
using test::medium;
using test::medium_boundary;
using test::turbid_liquid;
using test::with;
using test::with_integrator;

constexpr const char* kIntegrators[] = {"path", "path-pure"};
// Those that sample the paths of a uniform sky with little noise.
constexpr const char* kFurnaceIntegrators[] = {"path", "path-pure", "distribution", "bdpt"};

// A camera whose pixels all see in one direction.
Document narrow_view(scene::Scene scene, const Vec3& eye, const Vec3& target, const Vec3& up = {0, 1, 0}) {
  return test::document(std::move(scene), look_at(eye, target, up, 1e-4f), 16, 16);
}

// ---- Absorption.

// A plate of radiance 10 that faces up, 2 m below the origin.
scene::Scene plate_in_box(const Material& box) {
  scene::Scene scene;
  add(scene, scene::box({2, 2, 2}), box, at({0, -2, 0}));
  add(scene, test::quad(1), test::diffuse(Rgb(0), Rgb(10)), at({0, -2, 0}));
  return scene;
}

// A box without a surface attenuates camera paths, light paths and connections, in all integrators.
TEST(Absorption, InABoxWithoutASurface) {
  const scene::Scene scene = plate_in_box(medium_boundary(medium(Rgb(0), Rgb(std::numbers::ln2_v<float>))));
  for (const std::string& name : stress::unbiased_integrators()) {
    const Document d = with_integrator(narrow_view(scene, {0.01f, 3, 0.02f}, {0.01f, 0, 0.02f}, {0, 0, 1}), name);
    const test::Mean mean = test::mean_of(test::rendered(d, 64));
    EXPECT_NEAR(mean.value, 2.5, 4.5 * mean.standard_error + 1e-3) << name;
    EXPECT_LT(mean.standard_error, 0.05) << name;
  }
}

// Media that do not scatter have no variance in the model with scattering media.
TEST(Absorption, EqualsTheModelWithoutScattering) {
  for (const Material& box :
       {medium_boundary(medium(Rgb(0), Rgb(0.2f, 0.5f, 1))), test::liquid(1, {0.8f, 0.6f, 0.4f})}) {
    scene::Scene scene = plate_in_box(box);
    const Document without = narrow_view(scene, {0.01f, 3, 0.02f}, {0.01f, 0, 0.02f}, {0, 0, 1});
    // Selects the model with scattering media; far away.
    add(scene, test::sphere(1, 8, false), medium_boundary(medium(Rgb(1))), at({100, 0, 0}));
    const Document scattering = narrow_view(scene, {0.01f, 3, 0.02f}, {0.01f, 0, 0.02f}, {0, 0, 1});
    for (const char* name : kIntegrators) {
      const Rgb a = test::mean_color(test::rendered(with_integrator(without, name), 8)),
                b = test::mean_color(test::rendered(with_integrator(scattering, name), 8));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-5f * a[c]) << name;
    }
  }
}

// An atmosphere that only absorbs, bounded by a sphere of 2 m: no variance.
TEST(Absorption, InTheAtmosphere) {
  scene::Scene scene;
  add(scene, test::quad(1), test::diffuse(Rgb(0), Rgb(10)), at({0, 0, 0}));
  scene.atmosphere.medium = medium(Rgb(0), Rgb(0.2f, 0.5f, 1));
  scene.atmosphere.radius = 2;
  for (const char* name : kIntegrators) {
    const Document d = with_integrator(narrow_view(scene, {0.01f, 5, 0.02f}, {0.01f, 0, 0.02f}, {0, 0, 1}), name);
    const Rgb mean = test::mean_color(test::rendered(d, 4));
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(mean[c], 10 * std::exp(-2 * scene.atmosphere.medium.absorption[c]), 2e-3f * mean[c]) << name;
  }
}

// ---- Single scattering.

// Light of a point source that is scattered once on the way to the camera (the airlight integral):
//   L = int sigma_s p(cos) I / d^2 exp(-sigma_t (t + d)) dt
Rgb airlight(const MediumDescription& m, const Vec3& light, float intensity, double end) {
  constexpr int kSteps = 200000;
  double sum[3] = {};
  for (int i = 0; i < kSteps; ++i) {
    const double t = end * (i + 0.5) / kSteps;
    // The camera ray runs along -z.
    const double x = light.x, y = light.y, z = static_cast<double>(light.z) + t, d = std::sqrt(x * x + y * y + z * z);
    // Light travels from the light to the point, then along +z.
    const double cosine = -z / d, p = m.phase->eval(cosine);
    for (int c = 0; c < 3; ++c) {
      const double s = static_cast<double>(m.scattering[c]), k = s + static_cast<double>(m.absorption[c]);
      sum[c] += s * p * static_cast<double>(intensity) / (d * d) * std::exp(-k * (t + d)) * end / kSteps;
    }
  }
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

TEST(SingleScattering, EqualsTheAirlightIntegral) {
  const Vec3 light(0.3f, 0.9f, -2);
  constexpr float kIntensity = 10;
  for (const float g : {0.0f, 0.7f, -0.5f})
    for (const Rgb& absorption : {Rgb(0), Rgb(0.4f, 0.1f, 0.02f)}) {
      const MediumDescription m = medium({0.5f, 0.3f, 0.1f}, absorption, g);
      scene::Scene scene;
      scene.atmosphere.medium = m;
      scene::add_point_light(scene, light, kIntensity);
      // A surface behind the camera, because a scene has to have one.
      add(scene, test::quad(0.1f), test::diffuse(Rgb(0)), at({0, 0, 50}));
      Document d = narrow_view(scene, Vec3(0), {0, 0, -1});
      const Rgb expected = airlight(m, light, kIntensity, 120);
      const std::string what = "g = " + std::to_string(g);
      expect_radiance(with(d, "path.max-depth", "2"), 256, expected, 0.01, what + ", by depth");
      expect_radiance(with(d, "film.paths", "EVL"), 256, expected, 0.01, what + ", by class");
      for (const char* name : {"distribution", "bdpt"})
        expect_radiance(with(with_integrator(d, name), "film.paths", "EVL"), 256, expected, 0.01, what + ", " + name);
    }
}

// The same in a bounded atmosphere, whose shadow rays and camera rays end at its sphere.
TEST(SingleScattering, InABoundedAtmosphere) {
  const Vec3 light(0.3f, 0.9f, -2);
  const MediumDescription m = medium({0.5f, 0.3f, 0.1f});
  scene::Scene scene;
  scene.atmosphere.medium = m;
  scene.atmosphere.radius = 5;
  scene::add_point_light(scene, light, 10);
  add(scene, test::quad(0.1f), test::diffuse(Rgb(0)), at({0, 0, 1}));
  add(scene, test::quad(0.1f), test::diffuse(Rgb(0)), at({0, -0.2f, -1}));  // the bounds are centred at (0, -0.1, 0)
  const Document d = with(narrow_view(scene, Vec3(0), {0, 0, -1}), "path.max-depth", "2");
  expect_radiance(d, 256, airlight(m, light, 10, std::sqrt(25 - 0.01)), 0.01, "sphere of 5 m");
}

// A light with 100,000 times the power in a black box takes no samples of distances from the point light. With the power of
// all lights in place of that of the point lights, nearly all pixels would be black and the rest bright.
TEST(SingleScattering, AHiddenLightDoesNotMatter) {
  const Vec3 light(0.3f, 0.9f, -2);
  const MediumDescription m = medium({0.5f, 0.3f, 0.1f});
  scene::Scene scene;
  scene.atmosphere.medium = m;
  scene::add_point_light(scene, light, 10);
  add(scene, test::sphere(0.1f, 8, false), test::diffuse(Rgb(0), Rgb(4e7f)), at({0, 0, 50}));
  add(scene, scene::box({1, 1, 1}), test::diffuse(Rgb(0)), at({0, 0, 50}));
  const Document d = with(narrow_view(scene, Vec3(0), {0, 0, -1}), "film.paths", "EVL");
  expect_radiance(d, 256, airlight(m, light, 10, 120), 0.01, "path");
}

// ---- Conservation of energy.

// Media that do not absorb are invisible in a uniform sky, whatever surrounds them. The camera is outside or inside,
// where the radiance is greater by the square of the refractive index.
TEST(WhiteFurnace, ScatteringWithoutAbsorptionIsInvisible) {
  const MediumDescription media[] = {medium(Rgb(1)), medium({3, 1, 0.3f}), medium({3, 1, 0.3f}, Rgb(0), 0.8f),
                                     medium(Rgb(2), Rgb(0), -0.6f)};
  for (const MediumDescription& m : media)
    for (const Material& ball : {medium_boundary(m), turbid_liquid(1.5f, m)}) {
      scene::Scene scene;
      add(scene, test::sphere(1, 24, false), ball);
      scene.environment.tint = Rgb(1);
      for (const float distance : {3.0f, 0.3f})
        for (const char* name : kFurnaceIntegrators) {
          const Document d = narrow_view(scene, {0.1f, 0.2f, distance}, {0.1f, 0.2f, 0});
          const float eta = distance < 1 && !ball.boundary_only ? ball.ior : 1;
          expect_radiance(with_integrator(d, name), std::string(name) == "bdpt" ? 256 : 64, Rgb(eta * eta), 0.02,
                          std::string(name) + " at " + std::to_string(distance));
        }
    }
}

TEST(WhiteFurnace, Atmosphere) {
  scene::Scene scene;
  add(scene, test::sphere(0.5f, 16, false), test::diffuse(Rgb(1)));
  scene.atmosphere.medium = medium({0.5f, 0.2f, 1}, Rgb(0), 0.5f);
  scene.atmosphere.radius = 2;
  scene.environment.tint = Rgb(1);
  for (const float distance : {5.0f, 1.0f})
    for (const char* name : kFurnaceIntegrators)
      expect_radiance(with_integrator(narrow_view(scene, {0.1f, 0.2f, distance}, {0.1f, 0.2f, 0}), name), 64, Rgb(1),
                      0.02, name);
}

// ---- Multiple scattering.

// The fraction of diffuse light that passes a slab of isotropic particles without absorption, by its optical depth
// [Heaslet and Warming 1965]. The irradiance of a small white card above the slab, over pi, is this fraction of the
// radiance below.
TEST(Slab, TransmitsDiffuseLightAsTabulated) {
  constexpr std::pair<float, float> kTransmittance[] = {{0.5f, 0.7040f}, {1, 0.5532f}, {2, 0.3900f}, {5, 0.2077f}};
  for (const auto& [depth, transmittance] : kTransmittance) {
    scene::Scene scene;
    add(scene, scene::box({100, 0.5f, 100}), medium_boundary(medium(Rgb(depth))));
    Material emitter = test::diffuse(Rgb(0), Rgb(1));
    emitter.double_sided = false;
    add(scene, test::quad(100), emitter, at({0, -0.6f, 0}));
    Material card = test::diffuse(Rgb(1));
    card.double_sided = false;
    Mat4 down = at({0, 0.6f, 0});
    down[1][1] = -1;
    down[2][2] = -1;
    add(scene, test::quad(1e-3f), card, down);
    const Document d = narrow_view(scene, {0, 0.599f, 0}, {0, 0.6f, 0}, {0, 0, 1});
    expect_radiance(with_integrator(d, "path-pure"), 1024, Rgb(transmittance), 0.005,
                    "optical depth " + std::to_string(depth));
  }
}

// ---- Integrators without support.

TEST(Refusal, OfIntegratorsWithoutScatteringMedia) {
  // A lens, which light paths can hit.
  const Document place = with(test::foggy_cornell_box(), "camera.lens-radius", "0.2");
  for (const auto& info : integrator::integrator_infos()) {
    const Document d = with_integrator(place, info.name);
    const auto scene = scene::compile(d.scene, d.camera, nullptr);
    const std::string reason = render::incompatibility(d, *scene);
    EXPECT_EQ(reason.empty(), info.scattering_media) << info.name << ": " << reason;
    if (info.scattering_media) continue;
    EXPECT_NE(reason.find("scattering media"), std::string::npos) << reason;
    EXPECT_EQ(test::mean_of(test::rendered(d, 2)).value, 0) << info.name;
  }
}

}  // namespace
}  // namespace etendue
