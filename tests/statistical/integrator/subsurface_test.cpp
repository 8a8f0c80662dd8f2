// Subsurface diffusion against closed forms.
#include <gtest/gtest.h>

#include "render/incompatibility.h"
#include "scene/compiled_scene.h"
#include "support/integrator_scenes.h"

namespace etendue {
namespace {

using render::Document;
using test::Mean;

// A diffuse material with a diffusion profile; the mean free path in mm.
Material subsurface(const Vec3& albedo, double mean_free_path) {
  Material material = test::diffuse(Rgb(1));
  auto model = make_bsdf_model("subsurface");
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
}  // namespace etendue
