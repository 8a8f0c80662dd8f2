// Export of the edited scene through the file dialog.
#include "scene/builtin/builtin.h"
#include "scene/gltf/load_gltf.h"
#include "scene/gltf/save_gltf.h"
#include "viewer/scripted.h"

namespace etendue::export_scene_test {
namespace {

class ExportScene : public Viewer {
 protected:
  void SetUp() override {
    Viewer::SetUp();
    ASSERT_TRUE(scene::save_gltf(scene::find_builtin("cornell")->make(), path("room.glb")));
  }
};

TEST_F(ExportScene, DialogSavesTheEditedScene) {
  const json steps = json::array({{{"do", "wait"}, {"spp", 1}},
                                  set("material.0.roughness", 0.375),
                                  set("camera.lens-radius", 0.0625),
                                  click("scene.save"),
                                  click("files.accept"),
                                  {{"do", "wait"}, {"spp", 1}}});
  ASSERT_EQ(run(steps, path("room.glb")), 0);
  const auto saved = scene::load_gltf(path("room-saved.glb"));
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_EQ(saved->materials[0].roughness, 0.375f);
  EXPECT_EQ(saved->cameras[0].lens_radius, 0.0625f);
}

TEST_F(ExportScene, ShortcutOpensTheDialog) {
  const json steps = json::array({{{"do", "wait"}, {"spp", 1}}, key("ctrl+shift+e"), click("files.accept")});
  ASSERT_EQ(run(steps, path("room.glb")), 0);
  EXPECT_TRUE(fs::exists(path("room-saved.glb")));
}

}  // namespace
}  // namespace etendue::export_scene_test
