// Cameras that see something: after Reset camera and Frame all no image is black if the scene has light.
#include "viewer/viewport/lit_view.h"

#include "render/document.h"
#include "scene/builtin/scene_builder.h"
#include "scene/compiled_scene.h"
#include "scene/gltf/save_gltf.h"
#include "scripted.h"

namespace etendue::lit_view_test {
namespace {

using viewer::seen_surfaces;

// A closed room with an area light below the ceiling. From outside it is black.
scene::Scene closed_room() {
  scene::Scene s;
  const int grey = scene::add_diffuse(s, "grey", Rgb(0.7f));
  scene::add_box(s, "room", grey, {-3, -2, -4}, {3, 2, 4});
  s.nodes.back().name = "room";
  const int emitter = scene::add_emitter(s, "emitter", Rgb(20));
  scene::add(s, "light", scene::rectangle({-0.5f, 1.9f, -0.5f}, {1, 0, 0}, {0, 0, 1}), emitter);
  return s;
}

class LitView : public Viewer {
 protected:
  std::string saved(const scene::Scene& s) {
    const std::string file = path("room.glb");
    EXPECT_TRUE(scene::save_gltf(s, file));
    return file;
  }
  render::Document document(scene::Scene s) {
    auto d = render::new_document(saved(s));
    EXPECT_TRUE(d) << d.error().message;
    return *d;
  }
  static std::shared_ptr<const scene::CompiledScene> compiled(const render::Document& d) {
    return scene::compile(d.scene, d.camera, nullptr);
  }
};

TEST_F(LitView, LightIsFoundDirectlyAndByReflection) {
  const auto scene = compiled(document(closed_room()));
  const Camera inside = look_at({0, 0, 3.5f}, {0, 0, 0}, {0, 1, 0}, 1);
  EXPECT_EQ(seen_surfaces(*scene, inside, 1).all, 1);
  EXPECT_GT(seen_surfaces(*scene, inside, 1).lit, 0.9f);
  const Camera outside = look_at({0, 0, 20}, {0, 0, 0}, {0, 1, 0}, 1);
  EXPECT_GT(seen_surfaces(*scene, outside, 1).all, 0.05f);
  EXPECT_EQ(seen_surfaces(*scene, outside, 1).lit, 0);
  EXPECT_FALSE(seen_surfaces(*scene, outside, 1).suffice());
  const Camera away = look_at({0, 0, 20}, {0, 0, 40}, {0, 1, 0}, 1);
  EXPECT_EQ(seen_surfaces(*scene, away, 1).all, 0);
}

TEST_F(LitView, TheCameraOfTheFileIsUsedIfItSeesTheRoom) {
  scene::Scene s = closed_room();
  Camera camera = look_at({0, 0, 3.5f}, {0, 0, 0}, {0, 1, 0}, 1);
  camera.name = "inside";
  scene::add(s, camera);
  render::Document d = document(s);
  const Camera original = d.camera;
  d.camera = look_at({0, 0, 20}, {0, 0, 0}, {0, 1, 0}, 1);
  EXPECT_EQ(viewer::reset_camera(d, *compiled(d)), original);
}

TEST_F(LitView, AnotherViewReplacesACameraOfTheFileBehindAWall) {
  scene::Scene s = closed_room();
  scene::add(s, look_at({0, 0, 20}, {0, 0, 0}, {0, 1, 0}, 1));
  const render::Document d = document(s);
  const auto scene = compiled(d);
  const Camera camera = viewer::reset_camera(d, *scene);
  EXPECT_TRUE(seen_surfaces(*scene, camera, 1).suffice());
}

TEST_F(LitView, ASceneWithoutLightKeepsItsView) {
  scene::Scene s = closed_room();
  for (auto& material : s.materials) material.emission = Rgb(0);
  render::Document d = document(s);
  d = *render::with_text(d, "environment.preset", "none");
  const Camera camera = look_at({0, 0, 20}, {0, 0, 0}, {0, 1, 0}, 1);
  EXPECT_EQ(viewer::lit_camera(*compiled(d), camera, 1), camera);
}

// The camera of the file is behind a wall. Frame all alone would keep the direction of view, which shows the black side
// of the wall.
TEST_F(LitView, NeitherCommandLeavesABlackImage) {
  scene::Scene s = closed_room();
  scene::add(s, look_at({0, 0, 20}, {0, 0, 0}, {0, 1, 0}, 1));
  const json wait{{"do", "wait"}, {"spp", 16}};
  ASSERT_EQ(run(json::array({wait, file_step("state", path("behind.json")), key("home"), wait,
                             file_step("state", path("home.json")), key("ctrl+z"), wait, click("view.reset-camera"),
                             wait, file_step("state", path("reset.json"))}),
                saved(s)),
            0);
  EXPECT_EQ(state("behind.json")["darkness"], "surfaces are black");
  EXPECT_EQ(state("home.json")["darkness"], "none");
  EXPECT_EQ(state("home.json")["undo"], "Frame all");
  EXPECT_EQ(state("reset.json")["darkness"], "none");
  EXPECT_EQ(state("reset.json")["undo"], "Reset camera");
}

}  // namespace
}  // namespace etendue::lit_view_test
