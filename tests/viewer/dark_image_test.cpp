// What the viewer says about images in which there is next to nothing to see.
#include "viewer/viewport/dark_image.h"

#include <gtest/gtest.h>

#include "film/film.h"
#include "film/film_image.h"
#include "render/display_frame.h"
#include "render/document.h"
#include "render/session.h"
#include "scene/compiled_scene.h"

namespace etendue::viewer {
namespace {

std::vector<Rgb> pixels_of(const film::Film& film) {
  const std::vector<float> rgb = film::radiance_of(film);
  std::vector<Rgb> pixels;
  for (size_t i = 0; i + 2 < rgb.size(); i += 3) pixels.emplace_back(rgb[i], rgb[i + 1], rgb[i + 2]);
  return pixels;
}

Darkness darkness_of(render::Document document, uint32_t samples = 16) {
  document.width = document.height = 64;
  const auto scene = scene::compile(document.scene, document.camera, nullptr);
  render::Frame frame;
  frame.width = frame.height = 64;
  frame.samples = samples;
  frame.pixels = std::make_shared<const std::vector<Rgb>>(pixels_of(render::rendered(document, samples, 1)));
  return find_darkness(document, *scene, frame);
}

render::Document cornell() { return *render::new_document("cornell"); }

// The emission of the light, a material of its own, is switched off.
render::Document without_light() {
  render::Document d = cornell();
  auto scene = *d.scene;
  for (auto& material : scene.materials) material.emission = Rgb(0);
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return d;
}

TEST(DarkImage, LitSceneIsNotDark) { EXPECT_EQ(darkness_of(cornell()), Darkness::none); }

TEST(DarkImage, SceneWithoutLightIsBlack) {
  EXPECT_EQ(darkness_of(without_light()), Darkness::surfaces_are_black);
  EXPECT_EQ(darkness_of(*render::with_text(without_light(), "environment.preset", "studio")), Darkness::none);
}

TEST(DarkImage, ExposureCounts) {
  EXPECT_EQ(darkness_of(*render::with_text(cornell(), "camera.exposure", "-12")), Darkness::surfaces_are_black);
}

TEST(DarkImage, CameraThatLooksAwaySeesNoSurface) {
  render::Document d = cornell();
  d.camera.to_world[3] += Vec4(0, 0, 1000, 0);
  d.camera.to_world[0] = -d.camera.to_world[0];
  d.camera.to_world[2] = -d.camera.to_world[2];
  EXPECT_EQ(darkness_of(d), Darkness::no_surfaces);
  EXPECT_EQ(darkness_of(*render::with_text(d, "environment.preset", "uniform")), Darkness::none);
}

TEST(DarkImage, FewSamplesSayNothing) { EXPECT_EQ(darkness_of(without_light(), 4), Darkness::none); }

}  // namespace
}  // namespace etendue::viewer
