// Metropolis light transport against path tracing and bidirectional path tracing. t-tests over blocks of pixels with a
// false-alarm rate of 1 % per test.
#include <gtest/gtest.h>

#include "support/integrator_scenes.h"
#include "support/moving_scenes.h"
#include "support/resume.h"

namespace etendue::mlt_test {
namespace {

using render::Document;
using test::with;
using test::with_integrator;

Document by_mlt(const Document& d) {
  return with(with(with_integrator(d, "mlt"), "candidates", "4096"), "chains", "32");
}

constexpr const char* kOthers[] = {"lens-perturbation", "caustic-perturbation", "multi-chain", "lens-subpath"};

// The bidirectional mutation together with one other mutation, or alone. Chains then stay longer at a path. Many chains
// make the distribution of the mean nearly normal nevertheless.
Document with_only(const Document& d, const std::string& mutation) {
  Document only = with(by_mlt(d), "chains", "256");
  for (const char* other : kOthers)
    if (other != mutation) only = with(only, other, "0");
  return only;
}

TEST(Mlt, AgreesWithPathTracing) {
  const std::pair<const char*, Document> scenes[] = {{"cornell", test::cornell(test::kSize)},
                                                     {"glossy scene", test::glossy_scene()},
                                                     {"area light", test::balls_under_area_light()},
                                                     {"sky", test::balls_under_sky()},
                                                     {"lens", test::with_lens(test::balls_under_area_light())},
                                                     {"lens and shutter", test::motion_and_lens_scene()}};
  for (const auto& [name, d] : scenes) test::expect_same_mean(with_integrator(d, "path"), 256, by_mlt(d), 256, name, 6);
}

// Path tracing does not find all paths from a point light through glass, so the reference is bidirectional.
TEST(Mlt, PunctualLights) {
  for (const char* type : {"point", "spot", "directional"}) {
    const Document d = test::balls_under_light(type);
    test::expect_same_mean(with_integrator(d, "bdpt"), 256, by_mlt(d), 256, std::string(type) + " light", 3);
  }
}

TEST(Mlt, EachMutationWithTheBidirectionalOne) {
  for (const Document& d : {test::glossy_scene(), test::balls_under_sky()}) {
    const auto expected = test::replicated(with_integrator(d, "bdpt"), 256);
    for (const char* mutation : {"none", "lens-perturbation", "caustic-perturbation", "multi-chain", "lens-subpath"})
      test::expect_agreement(expected, test::replicated(with_only(d, mutation), 128), mutation, 10);
  }
}

TEST(Mlt, PathClassesAgree) {
  const Document d = test::balls_under_area_light();
  for (const char* paths : {"EL", "EDL", "ES.*L", "E.G.*L", "ED.*GL", "E(D|G)S+L|E.*DS+DL", "EDG.*L"}) {
    const Document part = with(d, "film.paths", paths);
    test::expect_same_mean(with_integrator(part, "path"), 512, by_mlt(part), 128, paths, 7);
  }
}

TEST(Mlt, MaximumDepthIsRespected) {
  const Document d = test::cornell(test::kSize);
  test::expect_same_mean(with(with_integrator(d, "path"), "max-depth", "3"), 256, with(by_mlt(d), "max-depth", "3"),
                         256, "three edges", 1);
}

// A surface that blocks half of all rays at random.
TEST(Mlt, StochasticOpacity) {
  auto scene = test::balls();
  Material veil = test::diffuse(Rgb(0.5f));
  veil.alpha_mode = AlphaMode::blend;
  veil.alpha = 0.5f;
  Mat4 before(1);
  before[3] = Vec4(0, 1.2f, 0, 1);
  test::add(scene, test::quad(1.5f), veil, before);
  scene.environment.tint = {0.7f, 0.8f, 1.0f};
  const Document d = test::view_from_above(std::move(scene));
  test::expect_same_mean(with_integrator(d, "path"), 256, by_mlt(d), 256, "veil", 1);
}

// Epochs of nearly one sample.
Document with_short_epochs(const Document& d) { return with(by_mlt(d), "candidates", "64"); }

TEST(Mlt, BitIdenticalForAnyNumberOfThreads) {
  Document d = test::with_lens(test::cornell(test::kSize));
  d.width = 70;
  d.height = 50;
  const auto one = test::rendered(with_short_epochs(d), 5, 1);
  for (const int threads : {2, 7}) {
    const auto many = test::rendered(with_short_epochs(d), 5, threads);
    for (size_t i = 0; i < one.pixels().size(); ++i) ASSERT_EQ(one.pixels()[i].sum, many.pixels()[i].sum) << threads;
  }
}

// A checkpoint stores a compact form of each path and recomputes the remainder: glass, a lens and a shutter.
TEST(Mlt, ResumesToTheSameBits) {
  for (Document d : {test::with_lens(test::balls_under_area_light()), test::motion_and_lens_scene()}) {
    d.width = 70;
    d.height = 50;
    test::expect_same_bits_after_resume(with_short_epochs(d), "mlt");
  }
}

TEST(Mlt, BlackSceneIsBlack) {
  scene::Scene scene;
  test::add(scene, test::quad(4), test::diffuse(Rgb(0.6f)));
  EXPECT_EQ(test::mean_of(test::rendered(by_mlt(test::view_from_above(std::move(scene))), 4)).value, 0);
}

// The wall of the integrating sphere has the same radiance everywhere.
TEST(Mlt, IntegratingSphereIsUniform) {
  const Document d = test::integrating_sphere(0.5, 0.5f, scene::Cap::reflecting, test::kSize);
  test::expect_same_mean(with_integrator(d, "path"), 64, by_mlt(d), 128, "integrating sphere", 1);
}

}  // namespace
}  // namespace etendue::mlt_test
