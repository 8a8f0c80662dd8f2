// Context menus of parameters, and colours as people type and see them.
#include "scripted.h"
#include "spectrum/rgb.h"
#include "viewer/viewport/srgb.h"

namespace etendue::parameter_menu_test {
namespace {

class ParameterMenu : public Viewer {
 protected:
  // Sets `name`, which changes `parameter`, and resets it by the context menu of `item`.
  void expect_reset(const std::string& name, const json& value, const std::string& parameter, const std::string& item,
                    const json& before) {
    const json right_click{{"do", "click"}, {"item", item}, {"button", "right"}};
    json steps = joined(json::array({{{"do", "wait"}, {"spp", 1}}}), before);
    steps = joined(steps, json::array({file_step("state", path("original.json")), set(name, value),
                                       file_step("state", path("changed.json")), right_click, click("menu.reset"),
                                       file_step("state", path("reset.json"))}));
    ASSERT_EQ(run(steps, "cornell", 1200, 900), 0) << item;
    EXPECT_NE(state("changed.json")["parameters"].at(parameter), state("original.json")["parameters"].at(parameter));
    EXPECT_EQ(state("reset.json")["parameters"], state("original.json")["parameters"]) << item;
  }
};

TEST_F(ParameterMenu, ResetsColours) {
  expect_reset("material.0.base-color.r", 0.1, "material.0.base-color.r", "material.0.base-color",
               json::array({click("tab.material")}));
}
TEST_F(ParameterMenu, ResetsVectors) {
  expect_reset("camera.eye.x", 0.5, "camera.eye.x", "camera.eye.y", json::array({click("tab.camera")}));
}
TEST_F(ParameterMenu, ResetsRotations) {
  expect_reset("node.0.euler.y", 30, "node.0.rotation.y", "node.0.euler.x",
               json::array({click("tab.scene"), click("scene.node.0")}));
}

TEST_F(ParameterMenu, HexadecimalValuesAreSrgb) {
  EXPECT_EQ(viewer::srgb_hex(Rgb(0.725f, 0.71f, 0.68f)), "#DDDBD7");
  EXPECT_EQ(viewer::srgb_hex(Rgb(0, 1, 2)), "#00FFFF");
  const Rgb back = viewer::linear_from_srgb(viewer::srgb_of_linear(Rgb(0.725f, 0.002f, 0.3f)));
  EXPECT_NEAR(back.r, 0.725f, 1e-5f);
  EXPECT_NEAR(back.g, 0.002f, 1e-5f);
}

TEST_F(ParameterMenu, TypedColoursAreSrgb) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             set("material.0.base-color.r", 0.5),
                             click("material.0.base-color"),
                             key("ctrl+a"),
                             {{"do", "type"}, {"text", "DDDBD7"}},
                             key("enter"),
                             file_step("state", path("s.json"))}),
                "cornell", 1200, 900),
            0);
  const json p = state("s.json")["parameters"];
  EXPECT_NEAR(p["material.0.base-color.r"].get<double>(), 0.725, 0.004);
  EXPECT_NEAR(p["material.0.base-color.g"].get<double>(), 0.71, 0.004);
  EXPECT_NEAR(p["material.0.base-color.b"].get<double>(), 0.68, 0.004);
}

}  // namespace
}  // namespace etendue::parameter_menu_test
