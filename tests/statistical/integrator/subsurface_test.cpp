// Subsurface diffusion against closed forms.
#include <gtest/gtest.h>

#include "bsdf/fresnel/fresnel.h"
#include "equations/pearson_test.h"
#include "render/incompatibility.h"
#include "scene/compiled_scene.h"
#include "support/directions.h"
#include "support/integrator_scenes.h"
#include "transport/wavefront/subsurface_scattering.h"

namespace etendue::subsurface_test {
namespace {

using render::Document;
using test::Mean;

// A material with a diffusion profile; the mean free path in mm.
Material subsurface(const Vec3& albedo, double mean_free_path, const char* name = "subsurface") {
  Material material = test::diffuse(Rgb(1));
  auto model = make_bsdf_model(name);
  for (int c = 0; c < 3; ++c) {
    model = model->with(std::string("albedo") + Triple::kParts[c], double{albedo[c]});
    model = model->with(std::string("mean-free-path") + Triple::kParts[c], mean_free_path * (c + 1));
  }
  material.model.model = model;
  return material;
}

// A plane of 20 m, seen at its middle.
Document plane_document(const Material& material, scene::Scene scene) {
  test::add(scene, test::quad(10), material);
  return test::document(std::move(scene), look_at({1, 3, 0.5f}, Vec3(0), {0, 1, 0}, 0.02f), 8, 8);
}

// A flat half-space under a uniform sky has the radiance of its albedo, whatever the mean free path: the profile is
// normalised. Four standard errors of at most 0.5 %; a false-alarm rate of 6e-5 for each of six comparisons.
TEST(Subsurface, FlatBodyHasItsAlbedo) {
  for (const char* integrator : {"path", "path-pure", "distribution"})
    for (const double mean_free_path : {1.0, 100.0}) {
      scene::Scene scene;
      scene.environment.tint = Rgb(1);
      const auto d =
          test::with_integrator(plane_document(subsurface({0.8f, 0.8f, 0.8f}, mean_free_path), scene), integrator);
      const Mean e = test::mean_of(test::rendered(d, 1024));
      EXPECT_NEAR(e.value, 0.8, 4 * e.standard_error + 8e-4) << integrator << ' ' << mean_free_path;
      EXPECT_LT(e.standard_error, 4e-3) << integrator;
    }
}

constexpr float kEta = 1.3f;  // of the model "dipole"

// The same below a boundary, which reflects the share f as a mirror. The total is 1 for a body without absorption.
TEST(Subsurface, FlatBodyBelowABoundaryHasItsAlbedo) {
  float refracted;
  const float cosine = 3 / std::sqrt(1 + 9 + 0.25f);  // of the camera of plane_document
  const double f = static_cast<double>(fresnel_dielectric(cosine, kEta, refracted));
  for (const char* integrator : {"path", "path-pure", "distribution"})
    for (const float albedo : {0.6f, 1.0f}) {
      scene::Scene scene;
      scene.environment.tint = Rgb(1);
      const auto d = test::with_integrator(plane_document(subsurface(Vec3(albedo), 1, "dipole"), scene), integrator);
      const Mean e = test::mean_of(test::rendered(d, 1024));
      EXPECT_NEAR(e.value, f + (1 - f) * static_cast<double>(albedo), 4 * e.standard_error + 1e-3)
          << integrator << ' ' << albedo;
      EXPECT_LT(e.standard_error, 5e-3) << integrator;
    }
}

// The integral of a profile over a sphere of radius a is the share of its light within 2 a on a plane, because the area
// of a spherical cap is pi times its squared chord. The sphere has 128 x 64 facets, which cause an error below 1e-3.
double share_below(double radius, double mean_free_path, double albedo, bool dipole) {
  if (!dipole) {
    const double d = mean_free_path / (1.9 - albedo + 3.5 * sqr(albedo - 0.8));
    return 1 - std::exp(-radius / d) / 4 - 0.75 * std::exp(-radius / (3 * d));
  }
  const double k = 1 + 4 * static_cast<double>(boundary_mismatch(kEta)) / 3;
  const double sigma = std::sqrt(3 * (1 - static_cast<double>(DipoleDiffusion::reduced_albedo(
                                              static_cast<float>(albedo), boundary_mismatch(kEta))))) /
                       mean_free_path;
  double within = 0, all = 0;
  for (const double z : {mean_free_path, k * mean_free_path}) {
    const double d = std::sqrt(z * z + radius * radius);
    within += std::exp(-sigma * z) - z / d * std::exp(-sigma * d);
    all += std::exp(-sigma * z);
  }
  return within / all;
}

TEST(Subsurface, SphereReturnsTheShareOfItsDiameter) {
  for (const bool dipole : {false, true}) {
    constexpr double kRadius = 0.5, kAlbedo = 0.9, kLength = 0.2;  // m
    scene::Scene scene;
    scene.environment.tint = Rgb(1);
    Material material = subsurface(Vec3(static_cast<float>(kAlbedo)), 1000 * kLength, dipole ? "dipole" : "subsurface");
    for (const char* part : {".g", ".b"})
      material.model.model = material.model->with(std::string("mean-free-path") + part, 1000 * kLength);
    test::add(scene, test::sphere(static_cast<float>(kRadius), 128, false), material);
    const Document d = test::with_integrator(
        test::document(std::move(scene), look_at({0.3f, 3, 0.1f}, {0, kRadius, 0}, {1, 0, 0}, 0.005f), 8, 8), "path");
    const Mean e = test::mean_of(test::rendered(d, 4096));
    const double f = dipole ? static_cast<double>(f0_from_ior(kEta)) : 0;
    const double expected = f + (1 - f) * kAlbedo * share_below(2 * kRadius, kLength, kAlbedo, dipole);
    EXPECT_NEAR(e.value, expected, 4 * e.standard_error + 1.5e-3) << dipole;
    EXPECT_LT(e.standard_error, 3e-3) << dipole;
  }
}

// Chi-square test of the points of entry on a plane: 16 rings of equal share by 8 sectors. Only probes along the normal
// find the plane, half of all. The false-alarm rate is 1 % for both profiles.
template <class Profile>
double p_value_of_entry_points(const char* model, bool dipole) {
  constexpr double kAlbedo = 0.8, kLength = 0.05;
  constexpr int kRings = 16, kSectors = 8, kSamples = 100'000;
  scene::Scene description;
  Material material = subsurface(Vec3(static_cast<float>(kAlbedo)), 1000 * kLength, model);
  for (const char* part : {".g", ".b"})
    material.model.model = material.model->with(std::string("mean-free-path") + part, 1000 * kLength);
  test::add(description, test::quad(1000), material);
  const auto scene = scene::compile(std::make_shared<const scene::Scene>(std::move(description)), Camera(), nullptr);
  Ray ray;
  ray.origin = {0.1f, 1, 0.2f};
  ray.direction = {0, -1, 0};
  const Hit hit = scene->intersect(ray, 0, 0);
  const Vec3 up(0, 1, 0);
  scene::SurfacePoint exit;
  scene->surfaces({&up, 1}, {&hit, 1}, &exit);
  const transport::SubsurfaceProbe<Profile> probe(*scene, exit, up, Rgb(static_cast<float>(kAlbedo)), 0);

  std::vector<int> counts(kRings * kSectors);
  int found = 0;
  test::Random random(5);
  for (int k = 0; k < kSamples; ++k) {
    typename transport::SubsurfaceProbe<Profile>::Entry entry;
    const Vec2 a = random.uniform2(), b = random.uniform2();
    if (!probe.sample(a.x, a.y, b.x, b.y, entry)) continue;
    ++found;
    scene::SurfacePoint at;
    scene->surfaces({&up, 1}, {&entry.hit, 1}, &at);
    const Vec3 offset = at.position - exit.position;
    const double share = share_below(static_cast<double>(glm::length(offset)), kLength, kAlbedo, dipole);
    const double turn = 0.5 + std::atan2(static_cast<double>(offset.z), static_cast<double>(offset.x)) / (2 * M_PI);
    ++counts[static_cast<size_t>(std::min(static_cast<int>(share * kRings), kRings - 1) * kSectors +
                                 std::min(static_cast<int>(turn * kSectors), kSectors - 1))];
  }
  const double expected = 0.5 * kSamples / (kRings * kSectors), missing = kSamples - found;
  double statistic = sqr(missing - 0.5 * kSamples) / (0.5 * kSamples);
  for (const int count : counts) statistic += sqr(count - expected) / expected;
  return equations::chi_square_survival(statistic, kRings * kSectors);
}

TEST(Subsurface, EntryPointsFollowTheProfile) {
  EXPECT_GT(p_value_of_entry_points<NormalizedDiffusion>("subsurface", false), 0.005);
  EXPECT_GT(p_value_of_entry_points<DipoleDiffusion>("dipole", true), 0.005);
}

// A half-space that is lit beyond an edge: the radiance at the edge is half of that of an evenly lit one, because the
// profile is symmetric. The light is a directional beam that a wall blocks on one side.
TEST(Subsurface, EdgeOfAShadowHasHalfTheRadiance) {
  scene::Scene scene;
  scene::Transform down;
  down.matrix = Mat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 5, 0, 1});
  test::add(scene, make_light("directional", {{"intensity", 2.0}}), down);
  Mat4 aside(1);
  aside[3] = Vec4(10, 1, 0, 1);
  test::add(scene, test::quad(10), test::diffuse(Rgb(0)), aside);
  test::add(scene, test::quad(10), subsurface({0.7f, 0.7f, 0.7f}, 100));
  const Document d = test::with_integrator(
      test::document(std::move(scene), look_at({-1, 0.6f, 0}, Vec3(0), {0, 1, 0}, 1e-3f), 8, 8), "path");
  const Mean e = test::mean_of(test::rendered(d, 2048));
  const double expected = 0.5 * 0.7 * 2 / M_PI;
  EXPECT_NEAR(e.value, expected, 4 * e.standard_error + 1e-3 * expected);
  EXPECT_LT(e.standard_error, 1.5e-2 * expected);
}

// A profile that is much narrower than all shapes is Lambert's model.
TEST(Subsurface, NarrowProfileIsLambertian) {
  const auto spheres = [](const Material& material) {
    scene::Scene scene;
    scene.environment.tint = {0.8f, 1, 0.6f};
    test::add(scene, test::quad(4), test::diffuse(Rgb(0.5f)));
    Mat4 above(1);
    above[3] = Vec4(0, 0.8f, 0, 1);
    test::add(scene, test::sphere(0.7f, 64, false), material, above);
    return test::view_from_above(std::move(scene));
  };
  test::expect_same_mean(test::with_integrator(spheres(subsurface({0.6f, 0.4f, 0.3f}, 0.05)), "path"), 256,
                         test::with_integrator(spheres(test::diffuse({0.6f, 0.4f, 0.3f})), "path"), 128, "sphere", 1);
}

TEST(Subsurface, OtherIntegratorsRefuse) {
  scene::Scene scene;
  scene.environment.tint = Rgb(1);
  const auto d = plane_document(subsurface(Vec3(0.5f), 1), scene);
  for (const auto& info : integrator::integrator_infos()) {
    const Document chosen = test::with_integrator(d, info.name);
    const std::string reason = render::incompatibility(chosen, *scene::compile(chosen.scene, chosen.camera, nullptr));
    if (info.subsurface)
      EXPECT_EQ(reason, "") << info.name;
    else
      EXPECT_NE(reason.find("does not support"), std::string::npos) << info.name;
  }
}

}  // namespace
}  // namespace etendue::subsurface_test
