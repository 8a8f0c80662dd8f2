// The Surface panel: checks, preview and lobe of the selected material, and a pinned material.
#include "scripted.h"

namespace etendue::surface_test {
namespace {

json steps_of(std::initializer_list<json> steps) { return json::array_t(steps); }

class SurfacePanel : public Viewer {
 protected:
  // Selects the white walls of the Cornell box and opens the Surface panel.
  static json opened() {
    return joined(small(1), steps_of({click("tab.material"), click("material.choose"), click("material.choose.0"),
                                      click("panel.surface"), wait_for("surface")}));
  }
  // Saves an image with the current material.
  static json rendered(const std::string& file) {
    return steps_of({{{"do", "wait"}, {"spp", 1}}, file_step("image", file)});
  }
};

TEST_F(SurfacePanel, ChecksFollowTheModelAndUndo) {
  const auto steps = joined(
      opened(),
      steps_of({file_step("state", path("gltf.json")), set("material.0.model", "phong"), wait_for("surface"),
                file_step("state", path("phong.json")), set("material.0.phong.specular.r", 1),
                set("material.0.phong.exponent", 1), wait_for("surface"), file_step("state", path("bright.json")),
                file_step("screenshot", path("panel.png")), key("ctrl+z"), key("ctrl+z"), key("ctrl+z"),
                wait_for("surface"), file_step("state", path("back.json"))}));
  ASSERT_EQ(run(steps, "", 1200, 700), 0);
  const auto verdicts = [&](const char* name) { return state(name)["surface"]["sides"][0]["badges"]; };
  EXPECT_EQ(state("gltf.json")["parameters"]["material.0.model"], "gltf");
  const json of_gltf = verdicts("gltf.json");
  for (const char* name : {"non-negative", "reciprocal", "conserves-energy", "well-sampled"})
    EXPECT_TRUE(of_gltf[name].get<bool>()) << name;
  EXPECT_EQ(state("phong.json")["parameters"]["material.0.model"], "phong");
  EXPECT_FALSE(verdicts("phong.json")["reciprocal"].get<bool>());
  EXPECT_FALSE(verdicts("bright.json")["conserves-energy"].get<bool>());
  EXPECT_EQ(state("back.json")["parameters"]["material.0.model"], "gltf");
  EXPECT_EQ(verdicts("back.json"), verdicts("gltf.json"));
}

TEST_F(SurfacePanel, MaterialIsPinnedForComparison) {
  const auto steps =
      joined(opened(), steps_of({click("surface.keep"), set("material.0.model", "modified-phong"), wait_for("surface"),
                                 file_step("state", path("two.json")), click("surface.drop"), wait_for("surface"),
                                 file_step("state", path("one.json"))}));
  ASSERT_EQ(run(steps, "", 1200, 700), 0);
  const auto two = state("two.json")["surface"]["sides"];
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[1]["model"], "glTF surface");
  EXPECT_NE(two[0]["model"], two[1]["model"]);
  EXPECT_EQ(state("one.json")["surface"]["sides"].size(), 1u);
}

// A drag in the lobe rotates the view and edits nothing.
TEST_F(SurfacePanel, DragRotatesTheLobe) {
  const auto steps = joined(opened(), steps_of({file_step("state", path("before.json")),
                                                file_step("screenshot", path("before.png")),
                                                {{"do", "drag"}, {"item", "surface.lobe"}, {"by", {60, 10}}},
                                                file_step("screenshot", path("after.png")),
                                                file_step("state", path("after.json"))}));
  ASSERT_EQ(run(steps, "", 1200, 700), 0);
  EXPECT_EQ(state("before.json")["undo_depth"], state("after.json")["undo_depth"]);
}

// The preview is rendered progressively. In the white furnace, a material that conserves energy disappears.
TEST_F(SurfacePanel, PreviewIsRenderedProgressively) {
  const auto steps = joined(opened(), steps_of({set("surface.light", "furnace"),
                                                wait_for("surface"),
                                                {{"do", "wait"}, {"seconds", 1}},
                                                file_step("state", path("ball.json"))}));
  ASSERT_EQ(run(steps, "", 1200, 700), 0);
  EXPECT_GT(state("ball.json")["surface"]["sides"][0]["ball_samples"].get<int>(), 4);
}

// The image changes with the model; undo restores it bit by bit.
TEST_F(SurfacePanel, ModelChangesTheImage) {
  const auto steps = joined(joined(joined(opened(), rendered(path("a.exr"))),
                                   joined(steps_of({set("material.0.model", "blinn-phong")}), rendered(path("b.exr")))),
                            joined(steps_of({set("material.0.model", "gltf")}), rendered(path("c.exr"))));
  ASSERT_EQ(run(steps, "", 1200, 700), 0);
  EXPECT_NE(saved_image("a.exr").layers[0].pixels, saved_image("b.exr").layers[0].pixels);
  EXPECT_EQ(saved_image("a.exr").layers[0].pixels, saved_image("c.exr").layers[0].pixels);
}

TEST_F(SurfacePanel, WaitFailsWithoutASelection) {
  EXPECT_EQ(run(joined(small(1), steps_of({click("panel.surface"), wait_for("surface")}))), 1);
}

}  // namespace
}  // namespace etendue::surface_test
