// What the viewer adjusts when it opens a scene: focus, near plane and exposure; and the bar of animated scenes.
#include "viewer/viewport/first_view.h"

#include "render/document.h"
#include "scene/compiled_scene.h"
#include "scene/gltf/save_gltf.h"
#include "scripted.h"

namespace etendue::first_view_test {
namespace {

using viewer::camera_for_navigation;

class FirstView : public Viewer {
 protected:
  // The Cornell box with its light multiplied by `factor`, as a file.
  std::string cornell_with_light(float factor) {
    render::Document d = *render::new_document("cornell");
    auto scene = *d.scene;
    for (auto& material : scene.materials) material.emission = material.emission * factor;
    d.scene = std::make_shared<const scene::Scene>(std::move(scene));
    const std::string file = path("box.glb");
    EXPECT_TRUE(scene::save_gltf(*d.scene, file));
    return file;
  }

  static Camera adjusted(const render::Document& document) {
    return camera_for_navigation(document, *scene::compile(document.scene, document.camera, nullptr));
  }
};

TEST_F(FirstView, APinholeIsFocusedOnTheSurfaceInTheCentre) {
  render::Document d = *render::new_document("cornell");
  d.camera.focus_distance = Camera{}.focus_distance;
  const Camera camera = adjusted(d);
  EXPECT_GT(camera.focus_distance, 8.0f);
  EXPECT_LT(camera.focus_distance, 14.0f);
  d.camera.lens_radius = 0.1f;
  EXPECT_EQ(adjusted(d).focus_distance, d.camera.focus_distance);
  d.camera.lens_radius = 0;
  d.camera.focus_distance = 3;
  EXPECT_EQ(adjusted(d).focus_distance, 3);
}

TEST_F(FirstView, ANearPlaneThatHidesSurfacesIsKept) {
  render::Document d = *render::new_document("cornell");
  d.camera.near_clip = 0.01f;
  EXPECT_EQ(adjusted(d).near_clip, 0);
  d.camera.near_clip = 9;
  EXPECT_EQ(adjusted(d).near_clip, 9);
}

TEST_F(FirstView, TheExposureSuitsABrightScene) {
  const json steps = json::array({{{"do", "wait"}, {"spp", 8}}, file_step("state", path("s.json"))});
  ASSERT_EQ(run(steps, cornell_with_light(1024)), 0);
  const json s = state("s.json");
  EXPECT_NEAR(s["parameters"]["camera.exposure"].get<double>(), -10, 2.5);
  EXPECT_EQ(s["undo_depth"], 0);
  EXPECT_EQ(s["edited"], false);
  ASSERT_EQ(run(steps, cornell_with_light(1)), 0);
  EXPECT_EQ(state("s.json")["parameters"]["camera.exposure"], 0);
}

// Dark surfaces in studio light become brighter, but the grey backdrop does not become white.
TEST_F(FirstView, TheBackdropLimitsTheExposure) {
  render::Document d = *render::new_document("cornell");
  auto scene = *d.scene;
  for (auto& material : scene.materials) {
    material.emission = Rgb(0);
    material.base_color = Rgb(0.01f);
    material.metallic = 0;
    material.specular = 0;
  }
  const std::string file = path("dark-walls.glb");
  ASSERT_TRUE(scene::save_gltf(scene, file));
  const json steps = json::array(
      {{{"do", "wait"}, {"spp", 8}}, {{"do", "wait"}, {"seconds", 0.5}}, file_step("state", path("s.json"))});
  ASSERT_EQ(run(steps, file), 0);
  const json parameters = state("s.json")["parameters"];
  EXPECT_EQ(parameters["environment.preset"], "studio");
  EXPECT_EQ(parameters["camera.exposure"], 1);
}

// Mirrors that a point light illuminates: there is no light in them at any exposure.
TEST_F(FirstView, TheStudioIsAddedWhereTheLightsLeaveSurfacesBlack) {
  render::Document d = *render::new_document("cornell");
  auto scene = *d.scene;
  for (auto& material : scene.materials) {
    material.emission = Rgb(0);
    material.metallic = 1;
    material.roughness = 0;
  }
  scene.lights.push_back(make_light("point"));
  scene.nodes[0].light = static_cast<int>(scene.lights.size()) - 1;
  const std::string file = path("dark.glb");
  ASSERT_TRUE(scene::save_gltf(scene, file));
  const json steps = json::array({{{"do", "wait"}, {"spp", 8}},
                                  {{"do", "wait"}, {"seconds", 0.5}},
                                  {{"do", "wait"}, {"spp", 8}},
                                  file_step("state", path("s.json"))});
  ASSERT_EQ(run(steps, file), 0);
  const json s = state("s.json");
  EXPECT_EQ(s["parameters"]["environment.preset"], "studio");
  EXPECT_EQ(s["undo_depth"], 0);
  EXPECT_EQ(s["edited"], false);
  ASSERT_EQ(run(steps, cornell_with_light(0.1f)), 0);
  EXPECT_NE(state("s.json")["parameters"]["environment.preset"], "studio") << "an exposure shows a weak light";
  EXPECT_GT(state("s.json")["parameters"]["camera.exposure"].get<double>(), 0);
}

// Of three objects a directional light illuminates a rough one; a mirror and glass stay black.
TEST_F(FirstView, TheStudioIsAddedWhereMostObjectsAreBlack) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  const std::string file = std::string(data) + "/gltf/IridescenceSuzanne.glb";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is missing";
  for (const auto& [width, height] : {std::pair(1280, 720), std::pair(900, 560)}) {
    const json steps = json::array({{{"do", "wait"}, {"spp", 16}},
                                    {{"do", "wait"}, {"seconds", 0.5}},
                                    {{"do", "wait"}, {"spp", 8}},
                                    file_step("state", path("s.json"))});
    ASSERT_EQ(run(steps, file, width, height), 0);
    EXPECT_EQ(state("s.json")["parameters"]["environment.preset"], "studio") << width;
    EXPECT_EQ(state("s.json")["darkness"], "none") << width;
  }
}

// In every environment the backdrop is a middle grey, at the exposure that the viewer chooses. The left border of the image
// shows the backdrop only.
TEST_F(FirstView, TheBackdropIsNeitherDarkNorBright) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  const json wait =
      json::array({{{"do", "wait"}, {"spp", 8}}, {{"do", "wait"}, {"seconds", 0.5}}, {{"do", "wait"}, {"spp", 2}}});
  for (const char* file : {"Duck.glb", "CesiumMilkTruck.glb"}) {
    json steps = wait;
    for (const char* environment : {"overcast", "sunset", "sky", "studio"}) {
      steps.push_back(set("environment.preset", environment));
      steps = joined(steps, wait);
      steps.push_back(file_step("image", path(std::string(environment) + ".png")));
    }
    ASSERT_EQ(run(steps, std::string(data) + "/gltf/" + file), 0);
    for (const char* environment : {"overcast", "sunset", "sky", "studio"}) {
      const auto image = image::read_linear(path(std::string(environment) + ".png"));
      ASSERT_TRUE(image) << image.error().message;
      const size_t left_middle = static_cast<size_t>(image->height / 2) * static_cast<size_t>(image->width);
      const float level = 255 * linear_to_srgb(image->find("")->pixels[3 * left_middle + 1]);
      EXPECT_GT(level, 60) << file << ' ' << environment;
      EXPECT_LT(level, 160) << file << ' ' << environment;
    }
  }
}

// Surfaces with the default material of glTF are a middle grey: the backdrop behind them is darker, so that they are seen.
// That is no edit.
TEST_F(FirstView, TheBackdropIsDarkBehindGreySurfaces) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  for (const auto& [file, brightness] :
       {std::pair("SimpleMorph/glTF/SimpleMorph.gltf", 0.25), std::pair("Duck.glb", 1.0)}) {
    const json steps = json::array({{{"do", "wait"}, {"spp", 8}},
                                    {{"do", "wait"}, {"seconds", 0.5}},
                                    {{"do", "wait"}, {"spp", 8}},
                                    file_step("state", path("s.json"))});
    ASSERT_EQ(run(steps, std::string(data) + "/gltf/" + file), 0);
    const json s = state("s.json");
    EXPECT_EQ(s["parameters"]["environment.backdrop-brightness"], brightness) << file;
    EXPECT_EQ(s["undo_depth"], 0) << file;
    EXPECT_EQ(s["edited"], false) << file;
  }
}

// Emitting surfaces are much brighter than what they illuminate. A lower exposure, which suits them, must not hide the
// rest.
TEST_F(FirstView, TheExposureForEmittersDoesNotHideTheRest) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  const std::string file = std::string(data) + "/gltf/LightsPunctualLamp/glTF/LightsPunctualLamp.gltf";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is missing";
  const json steps = json::array({{{"do", "wait"}, {"spp", 8}},
                                  {{"do", "wait"}, {"seconds", 0.5}},
                                  {{"do", "wait"}, {"spp", 16}},
                                  file_step("state", path("s.json"))});
  ASSERT_EQ(run(steps, file, 1280, 720), 0);
  const json s = state("s.json");
  EXPECT_EQ(s["darkness"], "none");
  EXPECT_LE(s["parameters"]["camera.exposure"].get<double>(), 0);
}

// The focus of a pinhole is on the surface in the middle of what it sees, also after "Frame all".
TEST_F(FirstView, AFramedCameraIsFocused) {
  const json steps = json::array({{{"do", "wait"}, {"spp", 2}},
                                  set("camera.focus-distance", 1000),
                                  set("camera.near-clip", 0.001),
                                  key("home"),
                                  {{"do", "wait"}, {"spp", 2}},
                                  file_step("state", path("s.json"))});
  ASSERT_EQ(run(steps, "cornell"), 0);
  const json parameters = state("s.json")["parameters"];
  EXPECT_LT(parameters["camera.focus-distance"].get<double>(), 20);
  EXPECT_GT(parameters["camera.focus-distance"].get<double>(), 1);
  EXPECT_EQ(parameters["camera.near-clip"], 0);
}

// Cameras of glTF files have a near plane of 1 cm and state no focus.
TEST_F(FirstView, ACameraOfTheFileIsAdjustedWhenItIsChosen) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  const std::string file = std::string(data) + "/gltf/Cameras/glTF/Cameras.gltf";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is missing";
  for (const char* camera : {"camera.choose.0", "camera.choose.1"}) {
    const json steps = json::array({{{"do", "wait"}, {"spp", 2}},
                                    click("tab.camera"),
                                    click("camera.choose"),
                                    click(camera),
                                    {{"do", "wait"}, {"spp", 2}},
                                    file_step("state", path("s.json"))});
    ASSERT_EQ(run(steps, file), 0);
    const json parameters = state("s.json")["parameters"];
    EXPECT_EQ(parameters["camera.near-clip"], 0) << camera;
    EXPECT_GT(parameters["camera.focus-distance"].get<double>(), 2) << camera;
  }
}

TEST_F(FirstView, AnEditOfTheUserEndsTheAdjustments) {
  ASSERT_EQ(run(json::array({set("camera.exposure", 1),
                             {{"do", "wait"}, {"spp", 8}},
                             {{"do", "wait"}, {"seconds", 0.5}},
                             file_step("state", path("s.json"))}),
                cornell_with_light(1024)),
            0);
  EXPECT_EQ(state("s.json")["parameters"]["camera.exposure"], 1);
}

// A sky has thousands of cd/m^2. The exposure belongs to the same step of undo.
TEST_F(FirstView, TheExposureSuitsAnotherEnvironment) {
  const json wait{{"do", "wait"}, {"spp", 8}};
  ASSERT_EQ(run(json::array({wait, set("environment.preset", "sky"), wait, file_step("state", path("sky.json")),
                             key("ctrl+z"), wait, file_step("state", path("undone.json"))})),
            0);
  EXPECT_LT(state("sky.json")["parameters"]["camera.exposure"].get<double>(), -4);
  EXPECT_EQ(state("sky.json")["undo_depth"], 1);
  EXPECT_EQ(state("undone.json")["parameters"]["camera.exposure"], 0);
  EXPECT_EQ(state("undone.json")["undo_depth"], 0);
}

TEST_F(FirstView, TheMessageAboutMissingLightsOpensTheLightPanel) {
  const std::string file = cornell_with_light(0);
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}}, click("notice.change"), file_step("state", path("s.json"))}),
                file),
            0);
  EXPECT_EQ(state("s.json")["tab"], "tab.light");
  EXPECT_EQ(state("s.json")["parameters"]["environment.preset"], "studio");
}

TEST_F(FirstView, AnimationsPlayWithoutEditingTheScene) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  const std::string file = std::string(data) + "/gltf/AnimatedMorphCube.glb";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is missing";
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             key("p"),
                             {{"do", "wait"}, {"seconds", 1.5}},
                             key("p"),
                             {{"do", "wait"}, {"seconds", 0.5}},
                             file_step("state", path("played.json")),
                             {{"do", "wait"}, {"seconds", 0.5}},
                             file_step("state", path("stopped.json"))}),
                file),
            0);
  const double time = state("played.json")["parameters"]["scene.time"];
  EXPECT_GT(time, 0.05);
  EXPECT_EQ(state("stopped.json")["parameters"]["scene.time"], time);
  EXPECT_EQ(state("played.json")["edited"], false);
  EXPECT_EQ(state("played.json")["undo_depth"], 1);
}

}  // namespace
}  // namespace etendue::first_view_test
