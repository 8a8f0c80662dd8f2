// The off-screen viewer, controlled by scripts: snapshots, undo, selection, transforms, and scripts themselves.
#include "scripted.h"

#include <cmath>
#include <set>

#include "support/sanitizer.h"

namespace etendue::viewer_test {
namespace {

bool same_pixels(const image::LayeredImage& a, const image::LayeredImage& b) {
  const auto *x = a.find(""), *y = b.find("");
  return x && y && a.width == b.width && a.height == b.height && x->pixels == y->pixels;
}

TEST_F(Viewer, SnapshotRestoresEverything) {
  const auto make = joined(small(), json::array({{{"do", "drag"}, {"from", {200, 300}}, {"to", {260, 280}}},
                                                 set("material.5.metallic", 1),
                                                 set("material.5.roughness", 0.25),
                                                 set("camera.exposure", 1.5),
                                                 set("render.integrator", "path-pure"),
                                                 {{"do", "wait"}, {"spp", 4}},
                                                 file_step("image", path("a.exr")),
                                                 file_step("state", path("a.json"))}));
  ASSERT_EQ(run(make), 0);
  ASSERT_EQ(
      run(json::array(
              {{{"do", "wait"}, {"spp", 4}}, file_step("image", path("b.exr")), file_step("state", path("b.json"))}),
          path("a.exr")),
      0);
  EXPECT_TRUE(same_pixels(saved_image("a.exr"), saved_image("b.exr")));
  EXPECT_EQ(state("a.json")["parameters"], state("b.json")["parameters"]);
  EXPECT_EQ(state("b.json")["undo_depth"], 0);
}

TEST_F(Viewer, PngIsTheDisplayedImageAndExrKeepsFireflies) {
  const auto saved = [&](const char* fireflies) {
    const std::string name = fireflies;
    return json::array({set("film.fireflies", name),
                        {{"do", "wait"}, {"spp", 16}},
                        file_step("image", path(name + ".png")),
                        file_step("image", path(name + ".exr"))});
  };
  // Small lights that are hit by chance only.
  ASSERT_EQ(run(joined(joined(joined(json::array({set("render.integrator", "path-pure")}), small(16)), saved("keep")),
                       saved("reweight"))),
            0);
  const auto kept = image::read_linear(path("keep.png")), shown = image::read_linear(path("reweight.png"));
  ASSERT_TRUE(kept && shown);
  EXPECT_FALSE(same_pixels(*kept, *shown));
  EXPECT_TRUE(same_pixels(saved_image("keep.exr"), saved_image("reweight.exr")));
}

TEST_F(Viewer, RestartRendersTheSameImageAgain) {
  const auto steps = json::array({file_step("image", path("a.exr")),
                                  click("render.restart"),
                                  {{"do", "wait"}, {"spp", 4}},
                                  file_step("image", path("b.exr")),
                                  file_step("state", path("s.json"))});
  ASSERT_EQ(run(joined(small(), steps), "cornell"), 0);
  EXPECT_TRUE(same_pixels(saved_image("a.exr"), saved_image("b.exr")));
  EXPECT_EQ(state("s.json")["traced_paths"], 4 * 96 * 96);
}

TEST_F(Viewer, DroppedSnapshotRestoresEverything) {
  const auto make = joined(small(), json::array({set("material.4.base-color.g", 0.1),
                                                 {{"do", "wait"}, {"spp", 4}},
                                                 file_step("image", path("a.exr")),
                                                 click("file.cornell"),
                                                 {{"do", "wait"}, {"spp", 1}},
                                                 file_step("open", path("a.exr")),
                                                 {{"do", "wait"}, {"spp", 4}},
                                                 file_step("image", path("b.exr"))}));
  ASSERT_EQ(run(make), 0);
  EXPECT_TRUE(same_pixels(saved_image("a.exr"), saved_image("b.exr")));
}

TEST_F(Viewer, DoubleClickKeepsTheValueAndEarlierSteps) {
  const json double_click{{"do", "click"}, {"item", "material.5.roughness"}, {"double", true}};
  const json drag{{"do", "drag"}, {"item", "material.5.roughness"}, {"by", {30, 0}}};
  ASSERT_EQ(run(json::array({set("material.5.roughness", 0.9), double_click, key("tab"), key("escape"),
                             file_step("state", path("kept.json")), drag, file_step("state", path("dragged.json")),
                             double_click, key("escape"), file_step("state", path("again.json"))})),
            0);
  const auto roughness = [&](const char* file) {
    return state(file)["parameters"]["material.5.roughness"].get<double>();
  };
  EXPECT_FLOAT_EQ(roughness("kept.json"), 0.9f);
  EXPECT_EQ(state("kept.json")["undo_depth"], 1);
  EXPECT_NE(roughness("dragged.json"), roughness("kept.json"));
  EXPECT_EQ(roughness("again.json"), roughness("dragged.json"));
  EXPECT_EQ(state("again.json")["undo_depth"], 2);
}

TEST_F(Viewer, UndoRestoresTheImageAndRedoTheEdit) {
  const auto steps = joined(small(), json::array({file_step("image", path("before.exr")),
                                                  file_step("state", path("before.json")),
                                                  set("material.5.base-color.r", 0.05),
                                                  {{"do", "wait"}, {"spp", 4}},
                                                  file_step("image", path("edited.exr")),
                                                  file_step("state", path("edited.json")),
                                                  key("ctrl+z"),
                                                  {{"do", "wait"}, {"spp", 4}},
                                                  file_step("image", path("undone.exr")),
                                                  file_step("state", path("undone.json")),
                                                  key("ctrl+shift+z"),
                                                  {{"do", "wait"}, {"spp", 4}},
                                                  file_step("image", path("redone.exr"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_EQ(state("edited.json")["undo_depth"], state("before.json")["undo_depth"].get<int>() + 1);
  EXPECT_EQ(state("undone.json")["undo_depth"], state("before.json")["undo_depth"]);
  EXPECT_EQ(state("undone.json")["parameters"], state("before.json")["parameters"]);
  EXPECT_FALSE(same_pixels(saved_image("before.exr"), saved_image("edited.exr")));
  EXPECT_TRUE(same_pixels(saved_image("before.exr"), saved_image("undone.exr")));
  EXPECT_TRUE(same_pixels(saved_image("edited.exr"), saved_image("redone.exr")));
}

TEST_F(Viewer, DragIsOneStepOfUndo) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             {{"do", "drag"}, {"from", {150, 300}}, {"to", {420, 200}}},
                             file_step("state", path("a.json")),
                             {{"do", "drag"}, {"from", {150, 300}}, {"to", {420, 200}}, {"button", "middle"}},
                             file_step("state", path("b.json"))})),
            0);
  EXPECT_EQ(state("a.json")["undo_depth"], 1);
  EXPECT_EQ(state("a.json")["undo"], "Orbit");
  EXPECT_EQ(state("b.json")["undo_depth"], 2);
  EXPECT_EQ(state("b.json")["undo"], "Pan");
}

TEST_F(Viewer, KeysSwitchTheIntegratorBackAndForth) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             key("1"),
                             file_step("state", path("a.json")),
                             key("tab"),
                             file_step("state", path("b.json")),
                             key("tab"),
                             file_step("state", path("c.json"))})),
            0);
  const auto integrator = [&](const char* name) {
    return state(name)["parameters"]["render.integrator"].get<std::string>();
  };
  EXPECT_EQ(integrator("b.json"), "path");
  EXPECT_NE(integrator("a.json"), "path");
  EXPECT_EQ(integrator("c.json"), integrator("a.json"));
}

TEST_F(Viewer, ClickSelectsTheObjectUnderThePointer) {
  // The light is in the middle, near the top of the image.
  ASSERT_EQ(
      run(json::array(
          {{{"do", "wait"}, {"spp", 1}}, {{"do", "pick"}, {"at", {270, 95}}}, file_step("state", path("a.json"))})),
      0);
  const auto selection = state("a.json")["selection"];
  EXPECT_EQ(selection["material"], 3);
  EXPECT_EQ(selection["node"], 5);
}

TEST_F(Viewer, TransformsAreEditedAndStoredInSnapshots) {
  ASSERT_EQ(run(joined(small(), json::array({set("node.7.translation.x", -0.5),
                                             set("node.7.euler.y", 30),
                                             set("node.7.scale.y", 0.5),
                                             {{"do", "wait"}, {"spp", 4}},
                                             file_step("image", path("a.exr")),
                                             file_step("state", path("a.json"))}))),
            0);
  const auto a = state("a.json");
  EXPECT_NEAR(a["parameters"]["node.7.rotation.y"].get<double>(), std::sin(M_PI / 12), 1e-6);
  EXPECT_NEAR(a["parameters"]["node.7.rotation.w"].get<double>(), std::cos(M_PI / 12), 1e-6);
  EXPECT_EQ(a["parameters"]["node.7.scale.y"], 0.5);
  EXPECT_EQ(a["undo"], "Scale of tall box");
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 4}},
                             file_step("image", path("b.exr")),
                             file_step("state", path("b.json")),
                             set("node.7.rotation.x", 0.5)}),
                path("a.exr")),
            0);
  EXPECT_TRUE(same_pixels(saved_image("a.exr"), saved_image("b.exr")));
  EXPECT_EQ(a["parameters"], state("b.json")["parameters"]);
}

TEST_F(Viewer, EnteredAnglesStayAndUndoRestoresThem) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             file_step("state", path("before.json")),
                             set("node.6.euler.y", 120),
                             set("node.6.euler.z", 10),
                             set("node.6.euler.y", 130),
                             file_step("state", path("a.json")),
                             key("ctrl+z"),
                             file_step("state", path("b.json")),
                             key("ctrl+z"),
                             key("ctrl+z"),
                             file_step("state", path("c.json"))})),
            0);
  const auto quaternion = [&](const char* name) {
    std::array<double, 4> q{};
    for (size_t c = 0; c < 4; ++c)
      q[c] = state(name)["parameters"][std::string("node.6.rotation.") + "xyzw"[c]].get<double>();
    return q;
  };
  // Ten degrees about z after the rotation about y.
  const auto expected = [](double y) {
    const double cy = std::cos(y * M_PI / 360), sy = std::sin(y * M_PI / 360);
    const double cz = std::cos(M_PI / 36), sz = std::sin(M_PI / 36);
    return std::array{-sy * sz, sy * cz, cy * sz, cy * cz};
  };
  for (size_t c = 0; c < 4; ++c) {
    EXPECT_NEAR(quaternion("a.json")[c], expected(130)[c], 1e-6) << c;
    EXPECT_NEAR(quaternion("b.json")[c], expected(120)[c], 1e-6) << c;
  }
  EXPECT_EQ(quaternion("c.json"), quaternion("before.json"));
  EXPECT_EQ(state("b.json")["undo"], "Rotation of short box");
  EXPECT_EQ(state("c.json")["undo_depth"], 0);
}

TEST_F(Viewer, DragOfAnAngleIsOneStep) {
  const json look = json::array({{{"do", "wait"}, {"spp", 1}},
                                 click("tab.scene"),
                                 click("scene.node.7"),
                                 {{"do", "drag"}, {"item", "node.7.euler.y"}, {"by", {40, 0}}},
                                 file_step("state", path("a.json"))});
  ASSERT_EQ(run(look), 0);
  EXPECT_EQ(state("a.json")["undo_depth"], 1);
  EXPECT_GT(state("a.json")["parameters"]["node.7.rotation.y"].get<double>(), 0.02);
  EXPECT_EQ(state("a.json")["parameters"]["node.7.rotation.x"], 0);
}

TEST_F(Viewer, EscapeClosesPopupsAndThenClearsTheSelection) {
  json steps = json::array({{{"do", "wait"}, {"spp", 1}}, {{"do", "pick"}, {"at", {270, 95}}}});
  // If a menu were still open, the click on the tab would only close it.
  for (const json& opened : {key("f1"), key("ctrl+k"), click("menu.view")})
    for (const json& step : {opened, key("escape")}) steps.push_back(step);
  steps.push_back(click("tab.light"));
  steps.push_back(file_step("state", path("a.json")));
  steps.push_back(key("escape"));
  steps.push_back(file_step("state", path("b.json")));
  ASSERT_EQ(run(steps), 0);
  EXPECT_EQ(state("a.json")["selection"]["node"], 5);
  EXPECT_EQ(state("a.json")["tab"], "tab.light");
  EXPECT_EQ(state("b.json")["selection"]["node"], -1);
}

// In a low window the View menu is scrolled; the click that opens it chooses none of its items.
TEST_F(Viewer, MenusFitIntoALowWindow) {
  const json steps = json::array({{{"do", "wait"}, {"spp", 1}},
                                  click("menu.view"),
                                  file_step("state", path("a.json")),
                                  click("menu.integrator"),
                                  file_step("state", path("b.json"))});
  ASSERT_EQ(run(steps, "", 700, 320), 0);
  for (const char* name : {"a.json", "b.json"}) EXPECT_EQ(state(name)["undo_depth"], 0) << name;
}

TEST_F(Viewer, EditOfTheDisplayDoesNotRestartTheRendering) {
  ASSERT_EQ(run(joined(small(16), json::array({set("camera.exposure", 2), set("display.curve", "agx"),
                                               set("view.false-color", true), file_step("state", path("a.json"))}))),
            0);
  EXPECT_EQ(state("a.json")["samples"], 16);
}

TEST_F(Viewer, IdleInterfaceTakesLittleProcessorTime) {
  if (test::kHasSanitizer) GTEST_SKIP() << "drawing may take longer than the longest interval allows";
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"seconds", 7}}, file_step("state", path("a.json"))})), 0);
  const double share = state("a.json")["interface_share"].get<double>();
  EXPECT_GT(share, 0);
  EXPECT_LT(share, 0.15);  // a tenth, and something for machines that do other things at the same time
}

TEST_F(Viewer, ScreenshotsShowTheImageAndTheInterface) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 2}},
                             file_step("screenshot", path("a.png")),
                             key("h"),
                             file_step("screenshot", path("b.png"))})),
            0);
  const auto a = image::read_linear(path("a.png")), b = image::read_linear(path("b.png"));
  ASSERT_TRUE(a) << a.error().message;
  ASSERT_TRUE(b) << b.error().message;
  EXPECT_EQ(a->width, 900);
  EXPECT_EQ(a->height, 560);
  // Neither screenshot is uniform, and hiding the interface changes it.
  const std::set<float> values(a->find("")->pixels.begin(), a->find("")->pixels.end());
  EXPECT_GT(values.size(), 50U);
  EXPECT_NE(a->find("")->pixels, b->find("")->pixels);
}

TEST_F(Viewer, AllTabsDrawAndAllActionsAreListed) {
  std::set<std::string> names;
  json steps = json::array({{{"do", "wait"}, {"spp", 1}}});
  for (const auto& entry : json::parse(viewer::widgets_json())) {
    const auto name = entry["name"].get<std::string>();
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_FALSE(entry["doc"].get<std::string>().empty()) << name;
    if (name.starts_with("tab.")) steps.push_back(click(name));
  }
  for (const char* name :
       {"snapshot.save", "render.integrator", "render.sampler", "film.filter", "camera.exposure", "scene.time",
        "node.0.euler.y", "node.0.rotation.w", "material.0.roughness", "edit.undo", "tab.render"})
    EXPECT_TRUE(names.contains(name)) << name;
  EXPECT_EQ(run(steps), 0);
}

TEST_F(Viewer, ImpossibleStepEndsTheScript) {
  for (const json& step : {set("material.99.roughness", 0.5), set("material.0.roughness", 7), set("no-such.thing", 1),
                           click("no.such.item"), json{{"do", "click"}, {"image", {1.5, 0.5}}},
                           file_step("open", path("missing.glb")), file_step("image", path("a.xyz"))}) {
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}}, step})), 1) << step;
    EXPECT_NE(::testing::internal::GetCapturedStderr().find("step 2"), std::string::npos) << step;
  }
}

TEST_F(Viewer, InvalidScriptsAndScenesAreInputErrors) {
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run(json::array({{{"do", "dance"}}})), 3);
  EXPECT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}}}), path("missing.glb")), 3);
  const auto text = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("dance"), std::string::npos);
  EXPECT_NE(text.find("missing.glb"), std::string::npos);
}

}  // namespace
}  // namespace etendue::viewer_test
