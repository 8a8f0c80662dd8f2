// Handles that move, rotate and scale objects, and icons of lights and cameras.
#include <cmath>

#include "scripted.h"

namespace etendue::gizmo_test {
namespace {

json drag_handle(const std::string& item, double x, double y) {
  return {{"do", "drag"}, {"item", item}, {"by", {x, y}}};
}

class Gizmo : public Viewer {
 protected:
  // The steps with a new box that is selected, in the built-in Cornell box.
  static json with_box(const json& steps) {
    return joined(json::array({{{"do", "wait"}, {"spp", 1}}, click("add.box"), {{"do", "wait"}, {"spp", 1}}}), steps);
  }

  double value(const json& report, const std::string& parameter) const {
    const int node = report["selection"]["node"].get<int>();
    return report["parameters"]["node." + std::to_string(node) + "." + parameter].get<double>();
  }
};

TEST_F(Gizmo, MovesAlongOneAxisInOneStep) {
  ASSERT_EQ(run(with_box(json::array({key("g"), file_step("state", path("a.json")), drag_handle("gizmo.x", -40, 3),
                                      file_step("state", path("b.json")), key("ctrl+z"),
                                      file_step("state", path("undone.json"))}))),
            0);
  const json a = state("a.json"), b = state("b.json");
  EXPECT_GT(value(b, "translation.x"), value(a, "translation.x"));
  for (const char* other : {"translation.y", "translation.z", "rotation.x", "rotation.w", "scale.x"})
    EXPECT_EQ(value(a, other), value(b, other)) << other;
  EXPECT_EQ(b["undo_depth"].get<int>(), a["undo_depth"].get<int>() + 1);
  EXPECT_EQ(b["undo"], "Move box");
  EXPECT_EQ(state("undone.json")["parameters"], a["parameters"]);
}

TEST_F(Gizmo, ControlSnaps) {
  const auto control = [](bool down) { return json{{"do", "key"}, {"key", "ctrl"}, {"down", down}}; };
  ASSERT_EQ(run(with_box(json::array(
                {key("g"), file_step("state", path("a.json")), control(true), drag_handle("gizmo.y", 2, -47),
                 control(false), file_step("state", path("b.json")), key("t"), control(true),
                 drag_handle("gizmo.z", -35, 9), control(false), file_step("state", path("c.json"))}))),
            0);
  const double moved = value(state("b.json"), "translation.y") - value(state("a.json"), "translation.y");
  EXPECT_GT(moved, 0);
  const double tenths = moved / 0.1;
  EXPECT_NEAR(tenths, std::round(tenths), 1e-4);
  const json c = state("c.json");
  const double degrees = 2 * std::acos(std::clamp(std::abs(value(c, "rotation.w")), 0.0, 1.0)) * 180 / M_PI;
  EXPECT_GT(degrees, 1);
  EXPECT_NEAR(degrees / 15, std::round(degrees / 15), 1e-3);
}

TEST_F(Gizmo, ScalesAlongOneAxis) {
  ASSERT_EQ(run(with_box(json::array({key("s"), file_step("state", path("a.json")), drag_handle("gizmo.x", -40, 0),
                                      file_step("state", path("b.json"))}))),
            0);
  const json a = state("a.json"), b = state("b.json");
  EXPECT_GT(value(b, "scale.x"), 1.1 * value(a, "scale.x"));
  for (const char* other : {"scale.y", "scale.z", "translation.x", "translation.y"})
    EXPECT_NEAR(value(a, other), value(b, other), 1e-5) << other;
}

// The node of the tall box is at the origin of the scene; the centre of its bounds has x = (2.65 + 4.72) / 2 m, from the
// published corners of the Cornell box. Scaling keeps that point: translation.x + scale.x * x = x.
TEST_F(Gizmo, ScalesAboutTheCentreOfTheGeometry) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             click("tab.scene"),
                             click("scene.node.7"),
                             key("s"),
                             {{"do", "wait"}, {"spp", 1}},
                             drag_handle("gizmo.x", -30, 0),
                             file_step("state", path("b.json"))})),
            0);
  const json b = state("b.json");
  const double scale = value(b, "scale.x");
  ASSERT_GT(scale, 1.1);
  EXPECT_NEAR(value(b, "translation.x") / (1 - scale), 3.685, 1e-3);
  for (const char* other : {"translation.y", "translation.z"}) EXPECT_NEAR(value(b, other), 0, 1e-5) << other;
}

TEST_F(Gizmo, MovedObjectsAreRestored) {
  const auto save = [&](const std::string& name) {
    return json::array({{{"do", "wait"}, {"spp", 4}},
                        file_step("image", path(name + ".exr")),
                        file_step("state", path(name + ".json"))});
  };
  const auto edits = json::array({click("add.light.spot"), key("g"), drag_handle("gizmo.x", 30, 10), key("t"),
                                  drag_handle("gizmo.z", 20, 25), click("add.box"), drag_handle("gizmo.y", 20, 10),
                                  key("s"), drag_handle("gizmo.z", 11, 10), key("g"), drag_handle("gizmo.y", 0, -20)});
  ASSERT_EQ(run(joined(joined(small(), edits), save("live"))), 0);
  ASSERT_EQ(run(save("reopened"), path("live.exr")), 0);
  EXPECT_EQ(state("live.json")["parameters"], state("reopened.json")["parameters"]);
  EXPECT_EQ(saved_image("live.exr").find("")->pixels, saved_image("reopened.exr").find("")->pixels);
}

TEST_F(Gizmo, IconsSelectLightsWithoutSurface) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             click("add.light.point"),
                             file_step("state", path("added.json")),
                             key("escape"),
                             file_step("state", path("none.json"))})),
            0);
  const int node = state("added.json")["selection"]["node"].get<int>();
  EXPECT_EQ(state("none.json")["selection"]["node"], -1);
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             click("add.light.point"),
                             key("escape"),
                             click("icon." + std::to_string(node)),
                             file_step("state", path("clicked.json"))})),
            0);
  EXPECT_EQ(state("clicked.json")["selection"]["node"], node);
}

TEST_F(Gizmo, DeletingTheObjectEndsTheHandles) {
  const json press{{"do", "drag"}, {"item", "gizmo.x"}, {"by", {10, 0}}};
  EXPECT_NE(run(with_box(json::array({key("g"), click("object.delete"), press}))), 0);
}

}  // namespace
}  // namespace etendue::gizmo_test
