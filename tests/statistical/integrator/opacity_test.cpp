// Alpha: blended and masked surfaces transmit the right fraction of light, also after a material becomes transparent by
// an edit.
#include <gtest/gtest.h>

#include "render/session.h"
#include "scene/compiled_scene.h"
#include "support/scenes.h"

namespace etendue::opacity_test {
namespace {

// A black thin surface of this opacity in front of a white environment.
render::Document sheet(AlphaMode mode, float alpha, float cutoff) {
  scene::Scene scene;
  Material m = test::diffuse(Rgb(0));
  m.alpha_mode = mode;
  m.alpha = alpha;
  m.alpha_cutoff = cutoff;
  test::add(scene, test::quad(10), m);
  scene.environment.tint = Rgb(1);
  return test::document(scene, look_at({0, 2, 0.01f}, {0, 0, 0}, {0, 1, 0}, 0.5f), 32, 32);
}

TEST(Opacity, BlendingBlocksAFractionOfTheRays) {
  for (const char* method : {"path", "path-pure"})
    for (const float alpha : {0.0f, 0.25f, 0.75f, 1.0f}) {
      auto d = sheet(AlphaMode::blend, alpha, 0.5f);
      d.method.integrator = method;
      EXPECT_NEAR(test::mean_of(test::rendered(d, 64)).value, 1 - alpha, 0.01) << method << ' ' << alpha;
    }
}

TEST(Opacity, MasksBlockAllOrNothing) {
  EXPECT_EQ(test::mean_of(test::rendered(sheet(AlphaMode::mask, 0.4f, 0.5f), 4)).value, 1);
  EXPECT_EQ(test::mean_of(test::rendered(sheet(AlphaMode::mask, 0.6f, 0.5f), 4)).value, 0);
  EXPECT_EQ(test::mean_of(test::rendered(sheet(AlphaMode::opaque, 0.1f, 0.5f), 4)).value, 0);
}

// Shadow rays are transmitted with the same probability: a floor under a half-transparent surface receives half of the
// light.
TEST(Opacity, ShadowRaysAreTransmittedAlike) {
  scene::Scene scene;
  test::add(scene, test::quad(10), test::diffuse(Rgb(0.5f)));
  Material m = test::diffuse(Rgb(0));
  m.alpha_mode = AlphaMode::blend;
  m.alpha = 0.5f;
  Mat4 above(1);
  above[3] = Vec4(0, 1, 0, 1);
  test::add(scene, test::quad(10), m, above);
  test::add_point_light(scene, {0, 2, 0}, 4);
  auto d = test::document(scene, look_at({0.5f, 0.5f, 0}, {0, 0, 0}, {0, 1, 0}, 1e-3f), 16, 16);
  EXPECT_NEAR(test::mean_of(test::rendered(d, 256)).value, 0.5 * (0.5 / 3.14159265), 0.003);
}

TEST(Opacity, EditOfAlphaNeedsNoRebuild) {
  const auto opaque = sheet(AlphaMode::opaque, 0.5f, 0.5f);
  const auto blended = *render::with_text(opaque, "material.0.alpha-mode", "blend");
  const auto first = scene::compile(opaque.scene, opaque.camera, nullptr);
  const auto second = scene::compile(blended.scene, blended.camera, first);
  EXPECT_FALSE(second->report().top_level_built);
  EXPECT_TRUE(second->has_transparency());
  render::Session session({.threads = 2, .interactive = false});
  auto limited = blended;
  limited.limits = {64, 0, 0};
  session.submit(opaque);
  session.submit(limited);
  session.finish();
  EXPECT_NEAR(test::mean_of(session.film_copy()).value, 0.5, 0.01);
}

}  // namespace
}  // namespace etendue::opacity_test
