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
    const json open_menu{{"do", "click"}, {"item", item}, {"button", "right"}};
    json steps = joined(json::array({{{"do", "wait"}, {"spp", 1}}}), before);
    steps = joined(steps, json::array({file_step("state", path("original.json")), set(name, value),
                                       file_step("state", path("changed.json")), open_menu, click("menu.reset"),
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

json right_click(const std::string& item) { return {{"do", "click"}, {"item", item}, {"button", "right"}}; }
json control_click(const std::string& item) { return {{"do", "click"}, {"item", item}, {"holding", "ctrl"}}; }
const json kShortWait{{"do", "wait"}, {"seconds", 0.2}};

// A lens is reset to that of the opened file, as an edit of the camera.
TEST_F(ParameterMenu, ResetsTheLens) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             file_step("state", path("original.json")),
                             set("lens.f-number", 2),
                             set("lens.focal-length", 80),
                             file_step("state", path("changed.json")),
                             control_click("lens.focal-length"),
                             right_click("lens.f-number"),
                             click("menu.reset"),
                             kShortWait,
                             file_step("state", path("reset.json")),
                             key("ctrl+z"),
                             key("ctrl+z"),
                             file_step("state", path("undone.json"))}),
                "cornell", 1200, 900),
            0);
  const auto parameters = [&](const char* file) { return state(file)["parameters"]; };
  const double original = parameters("original.json")["camera.yfov"].get<double>();
  EXPECT_LT(parameters("changed.json")["camera.yfov"].get<double>(), 0.8 * original);
  EXPECT_NEAR(parameters("reset.json")["camera.yfov"].get<double>(), original, 1e-6);
  EXPECT_EQ(parameters("reset.json")["camera.lens-radius"], 0.0);
  EXPECT_EQ(parameters("undone.json"), parameters("changed.json"));
}

// The entry Reset of a context menu is disabled while the parameter has its default. A click on it then does not close
// the menu.
TEST_F(ParameterMenu, ResetsParametersOfPanels) {
  const std::pair<const char*, json> changes[] = {
      {"compare.repeats", 7},       {"compare.rule", "samples"},    {"sampling.points", 16},
      {"lab.experiment", "markov"}, {"surface.light", "furnace"},   {"trace.sample", 3},
      {"view.aov", "albedo"},       {"meter.efficacy", "daylight"}, {"advice.error", 0.5},
  };
  json steps = json::array({{{"do", "wait"}, {"spp", 1}}, set("material.0.model", "lambert"), click("render.pause")});
  for (const auto& [name, value] : changes)
    steps = joined(steps, json::array({set(name, value), right_click(name), click("menu.reset"), kShortWait,
                                       file_step("state", path(std::string(name) + ".json")), right_click(name),
                                       click("menu.reset"), kShortWait,
                                       file_step("state", path(std::string(name) + ".again.json")), key("escape")}));
  ASSERT_EQ(run(steps, "cornell", 1200, 900), 0);
  for (const auto& [name, value] : changes) {
    EXPECT_EQ(state(std::string(name) + ".json")["popup_open"], false) << name << " cannot be reset";
    EXPECT_EQ(state(std::string(name) + ".again.json")["popup_open"], true) << name << " is not reset";
  }
}

// Afterwards, the context menu finds the parameter at its default; a changed value can be reset.
TEST_F(ParameterMenu, ControlClickResetsParametersOfPanels) {
  json steps = json::array({{{"do", "wait"}, {"spp", 1}}, set("material.0.model", "lambert"), click("render.pause")});
  const std::pair<const char*, json> changes[] = {{"compare.repeats", 7}, {"sampling.points", 16}, {"lab.seed", 5},
                                                  {"surface.angle", 0.5}, {"trace.sample", 3},     {"advice.pilot", 2}};
  const auto reset_by_menu = [&](const std::string& name, const std::string& report) {
    return json::array(
        {right_click(name), click("menu.reset"), kShortWait, file_step("state", path(report)), key("escape")});
  };
  for (const auto& [name, value] : changes) {
    const std::string stem = name;
    steps = joined(steps, json::array({set(name, value), control_click(name)}));
    steps = joined(joined(steps, reset_by_menu(name, stem + ".json")), json::array({set(name, value)}));
    steps = joined(steps, reset_by_menu(name, stem + ".changed.json"));
  }
  ASSERT_EQ(run(steps, "cornell", 1200, 900), 0);
  for (const auto& [name, value] : changes) {
    EXPECT_EQ(state(std::string(name) + ".json")["popup_open"], true) << name << " is not reset";
    EXPECT_EQ(state(std::string(name) + ".changed.json")["popup_open"], false) << name << " cannot be reset";
  }
}

// --set takes parameters of the document only.
TEST_F(ParameterMenu, OnlyParametersOfTheDocumentAreCommandLineOptions) {
  const char* const in_document = "camera.focus-distance";
  const char* const others[] = {"lens.f-number", "sampling.points", "preferences.font-size",
                                "preferences.scene-folder"};
  const auto file = [&](const std::string& name) { return path(name + ".json"); };
  json steps = json::array({{{"do", "wait"}, {"spp", 1}}});
  const auto open_menu = [&](const std::string& name, const json& value) {
    steps = joined(steps, json::array({set(name, value), right_click(name), kShortWait, file_step("state", file(name)),
                                       key("escape")}));
  };
  open_menu(in_document, 3);
  open_menu(others[0], 2);
  open_menu(others[1], 20);
  open_menu(others[2], 17);
  open_menu(others[3], "/tmp");
  ASSERT_EQ(run(steps, "cornell", 1200, 900), 0);
  const auto has_item = [&](const std::string& name, const char* item) {
    return state(name + ".json")["items"].contains(item);
  };
  EXPECT_TRUE(has_item(in_document, "menu.copy-option"));
  for (const char* name : others) {
    EXPECT_TRUE(has_item(name, "menu.reset")) << name;
    EXPECT_FALSE(has_item(name, "menu.copy-option")) << name;
  }
}

// A tooltip names a click only if it has an effect.
TEST_F(ParameterMenu, TooltipsNameClicksThatHaveAnEffect) {
  json steps = json::array({{{"do", "wait"}, {"spp", 1}}, click("add.light.point")});
  // Leaves the pointer on an item.
  const auto hover = [&](const std::string& item) {
    steps = joined(steps, json::array({right_click(item),
                                       kShortWait,
                                       key("escape"),
                                       {{"do", "wait"}, {"seconds", 0.6}},
                                       file_step("state", path(item + ".json"))}));
  };
  steps.push_back(set("light.0.intensity", 5));
  hover("light.0.intensity");
  const char* const disabled = "environment.backdrop-brightness";
  steps = joined(steps, json::array({click(disabled),
                                     {{"do", "wait"}, {"seconds", 0.6}},
                                     file_step("state", path(std::string(disabled) + ".json"))}));
  steps.push_back(set("camera.focus-distance", 3));
  hover("camera.focus-distance");
  hover("camera.projection");
  steps.push_back(set("lens.f-number", 2));
  hover("lens.f-number");
  ASSERT_EQ(run(steps, "cornell", 1200, 900), 0);
  const auto contains = [&](const std::string& item, const char* text) {
    const std::string shown = state(item + ".json")["tooltip"];
    EXPECT_FALSE(shown.empty()) << item;
    return shown.find(text) != std::string::npos;
  };
  for (const char* item : {"camera.focus-distance", "lens.f-number"})
    EXPECT_TRUE(contains(item, "Double click: enter a value. Ctrl+click: reset")) << item;
  EXPECT_TRUE(contains("light.0.intensity", "Double click: enter a value"));
  EXPECT_FALSE(contains("light.0.intensity", "Ctrl+click")) << "an added light has no value in the file";
  EXPECT_FALSE(contains(disabled, "lick")) << "it is disabled";
  EXPECT_FALSE(contains("camera.projection", "lick")) << "a choice has no text input";
}

}  // namespace
}  // namespace etendue::parameter_menu_test
