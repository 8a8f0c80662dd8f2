// Preferences, the command palette, the filter of panels, and messages.
#include <algorithm>

#include "render/document.h"
#include "scene/scene.h"
#include "scripted.h"
#include "viewer/script/item_registry.h"
#include "viewer/state/notices.h"

namespace etendue::preferences_test {
namespace {

class Preferences : public Viewer {
 protected:
  int run_with_settings(const json& steps) {
    std::ofstream(path("kept.json")) << steps.dump();
    viewer::ViewOptions options;
    options.offscreen = true;
    options.script = path("kept.json");
    options.settings = path("settings");
    return viewer::run_viewer(options);
  }
  json settings() const { return state("settings/viewer.json"); }
};

TEST_F(Preferences, AreKeptAndAppliedAtTheNextStart) {
  ASSERT_EQ(run_with_settings(json::array({set("preferences.theme", "light"), set("preferences.scale", "1.5"),
                                           set("preferences.font-size", 18), set("preferences.environment", "overcast"),
                                           click("preferences.close")})),
            0);
  EXPECT_EQ(settings()["dark"], false);
  EXPECT_EQ(settings()["scale"], 1.5);
  EXPECT_EQ(settings()["font_size"], 18);
  EXPECT_EQ(settings()["environment"], "overcast");
  ASSERT_EQ(run_with_settings(json::array({file_step("state", path("next.json"))})), 0);
  EXPECT_EQ(state("next.json")["ui_scale"], 1.5);
}

TEST_F(Preferences, IntegratorOfOpenedScenesIsChosenAutomatically) {
  ASSERT_EQ(run_with_settings(json::array({wait_for("automatic"), file_step("state", path("chosen.json")),
                                           set("preferences.automatic", false), click("preferences.close")})),
            0);
  const json chosen = state("chosen.json")["automatic"];
  ASSERT_TRUE(chosen.is_object());
  EXPECT_NE(chosen["reason"], "");
  EXPECT_EQ(settings()["automatic_integrator"], false);
  ASSERT_EQ(run_with_settings(json::array({file_step("state", path("path.json"))})), 0);
  EXPECT_TRUE(state("path.json")["automatic"].is_null());
}

TEST_F(Preferences, ShortcutsCanBeReplaced) {
  ASSERT_EQ(run_with_settings(json::array({click("app.preferences"),
                                           {{"do", "wait"}, {"seconds", 0.2}},
                                           click("preferences.keyboard"),
                                           click("preferences.shortcut.render.restart"),
                                           key("ctrl+shift+r"),
                                           click("preferences.shortcut.display.next-aov"),
                                           key("l"),
                                           click("preferences.close")})),
            0);
  EXPECT_EQ(settings()["shortcuts"]["render.restart"], "ctrl+shift+r");
  EXPECT_EQ(settings()["shortcuts"]["display.next-aov"], "l");
  EXPECT_EQ(settings()["shortcuts"]["display.toggle-false-color"], "")
      << "its former shortcut belongs to another action";
}

TEST_F(Preferences, UnreadableSettingsAreSetAside) {
  fs::create_directories(path("settings"));
  std::ofstream(path("settings/viewer.json")) << R"({"window": 3})";
  ASSERT_EQ(run_with_settings(json::array({file_step("state", path("a.json"))})), 0);
  EXPECT_TRUE(fs::exists(path("settings/viewer.json.damaged")));
  EXPECT_GE(state("a.json")["messages"], 1);
}

TEST_F(Preferences, NumbersOutOfRangeAreClamped) {
  fs::create_directories(path("settings"));
  std::ofstream(path("settings/viewer.json"))
      << R"({"window": {"width": -1e30, "height": 1e30, "maximised": false}, "column": 1e30, "dark": true, "recent": [],
            "folder": "", "threads": 1e30})";
  ASSERT_EQ(run_with_settings(json::array({set("preferences.theme", "light"), click("preferences.close")})), 0);
  EXPECT_FALSE(fs::exists(path("settings/viewer.json.damaged")));
  EXPECT_EQ(settings()["threads"], 1024);
  EXPECT_EQ(settings()["dark"], false);
}

TEST_F(Viewer, PaletteFindsParametersAndValues) {
  ASSERT_EQ(run(json::array({key("ctrl+k"),
                             {{"do", "wait"}, {"seconds", 0.2}},
                             {{"do", "type"}, {"text", "tone neutral"}},
                             key("enter"),
                             file_step("state", path("value.json")),
                             key("ctrl+k"),
                             {{"do", "wait"}, {"seconds", 0.2}},
                             {{"do", "type"}, {"text", "focus distance"}},
                             key("enter"),
                             {{"do", "wait"}, {"seconds", 0.2}},
                             file_step("state", path("parameter.json"))})),
            0);
  EXPECT_EQ(state("value.json")["parameters"]["display.curve"], "neutral");
  EXPECT_EQ(state("parameter.json")["tab"], "tab.camera");
}

// Opens the command palette, and chooses the first entry for a text.
json choose(const std::string& text) {
  const json wait{{"do", "wait"}, {"seconds", 0.3}};
  return json::array({key("ctrl+k"), wait, {{"do", "type"}, {"text", text}}, key("enter"), wait});
}

TEST_F(Preferences, ThePaletteFindsThem) {
  const std::pair<const char*, const char*> searches[] = {
      {"font size", "preferences.font-size"}, {"ui scale", "preferences.scale"},
      {"threads", "preferences.threads"},     {"default environment", "preferences.environment"},
      {"denoiser", "preferences.denoiser"},   {"environment folder", "preferences.environment-folder"}};
  // The list of shortcuts was shown last.
  json steps = joined(choose("edit keyboard shortcuts"),
                      json::array({file_step("state", path("keyboard.json")), click("preferences.close")}));
  for (const auto& [text, name] : searches) {
    steps = joined(steps, choose(text));
    steps.push_back(file_step("state", path(std::string(name) + ".json")));
    steps.push_back(click("preferences.close"));
  }
  ASSERT_EQ(run_with_settings(joined(joined(steps, choose("theme: light")), choose("denoiser: regression"))), 0);
  EXPECT_TRUE(state("keyboard.json")["items"].contains("preferences.shortcut.file.open"));
  for (const auto& [text, name] : searches)
    EXPECT_TRUE(state(std::string(name) + ".json")["items"].contains(name)) << text;
  EXPECT_EQ(settings()["dark"], false);
  EXPECT_EQ(settings()["denoiser"], "regression");
}

TEST_F(Preferences, EscapeClosesTheMenuBeforeTheDialog) {
  const json wait{{"do", "wait"}, {"seconds", 0.2}};
  const json menu{{"do", "click"}, {"item", "preferences.font-size"}, {"button", "right"}};
  ASSERT_EQ(run_with_settings(json::array({click("app.preferences"), wait, menu, wait, key("escape"), wait,
                                           file_step("state", path("menu.json")), click("preferences.scale"), wait,
                                           key("escape"), wait, file_step("state", path("list.json")), key("escape"),
                                           wait, file_step("state", path("dialog.json"))})),
            0);
  for (const char* report : {"menu.json", "list.json"})
    EXPECT_TRUE(state(report)["items"].contains("preferences.close")) << report;
  EXPECT_FALSE(state("dialog.json")["items"].contains("preferences.close"));
}

// A message appears at the lower left, where it would cover buttons of a dialog.
TEST_F(Preferences, MessagesWaitWhileADialogIsOpen) {
  const json wait{{"do", "wait"}, {"seconds", 0.3}};
  const json steps = json::array({{{"do", "wait"}, {"spp", 1}},
                                  click("compare.pin"),
                                  wait,
                                  file_step("state", path("before.json")),
                                  click("app.preferences"),
                                  wait,
                                  file_step("state", path("open.json")),
                                  click("preferences.close"),
                                  wait,
                                  file_step("state", path("after.json"))});
  ASSERT_EQ(run_with_settings(steps), 0);
  EXPECT_TRUE(state("before.json")["items"].contains("notice.close"));
  EXPECT_FALSE(state("open.json")["items"].contains("notice.close"));
  EXPECT_TRUE(state("after.json")["items"].contains("notice.close"));
}

TEST_F(Preferences, AreReset) {
  const auto right_click = [](const char* item) { return json{{"do", "click"}, {"item", item}, {"button", "right"}}; };
  const json wait{{"do", "wait"}, {"seconds", 0.3}};
  const json changes = json::array({set("preferences.font-size", 20), set("preferences.threads", 3),
                                    set("preferences.theme", "light"), set("preferences.scene-folder", "/tmp")});
  ASSERT_EQ(run_with_settings(joined(changes, json::array({wait, click("preferences.close")}))), 0);
  EXPECT_EQ(settings()["font_size"], 20);
  EXPECT_EQ(settings()["threads"], 3);
  EXPECT_EQ(settings()["dark"], false);
  EXPECT_EQ(settings()["scene_folder"], "/tmp");
  json resets = json::array({click("app.preferences"), wait});
  for (const char* number : {"preferences.font-size", "preferences.threads"})
    resets = joined(resets, json::array({{{"do", "click"}, {"item", number}, {"holding", "ctrl"}}, wait}));
  for (const char* other : {"preferences.theme", "preferences.scene-folder"})
    resets = joined(resets, json::array({right_click(other), click("menu.reset"), wait}));
  ASSERT_EQ(run_with_settings(joined(resets, json::array({click("preferences.close")}))), 0);
  EXPECT_EQ(settings()["font_size"], 16);
  EXPECT_EQ(settings()["threads"], 0);
  EXPECT_EQ(settings()["dark"], true);
  EXPECT_EQ(settings()["scene_folder"], "");
}

TEST_F(Viewer, PaletteFindsParametersOfPanels) {
  struct Search {
    const char *text, *name, *panel;
  };
  const Search searches[] = {{"focal length", "lens.focal-length", "tab.camera"},
                             {"f-number lens", "lens.f-number", "tab.camera"},
                             {"sensor size", "meter.sensor", "tab.light"},
                             {"candle", "light.preset", "tab.light"},
                             {"pilot time", "advice.pilot", "tab.render"},
                             {"view.aov", "view.aov", "tab.display"},
                             {"repeats conv", "compare.repeats", "panel.convergence"},
                             {"elementary intervals", "sampling.intervals", "panel.sampling"},
                             {"shadow rays trace", "trace.shadow-rays", "panel.trace"},
                             {"burn-in", "lab.sampling.burn-in", "panel.lab"}};
  json steps = json::array({{{"do", "wait"}, {"spp", 1}}, set("lab.experiment", "markov"), click("add.light.point")});
  for (const Search& search : searches)
    steps = joined(joined(steps, choose(search.text)),
                   json::array({file_step("state", path(std::string(search.name) + ".json"))}));
  steps = joined(joined(steps, choose("aov: albedo")), choose("experiment: quadrature"));
  steps.push_back(wait_for("lab"));
  ASSERT_EQ(run(joined(steps, json::array({file_step("state", path("values.json"))}))), 0);
  for (const Search& search : searches) {
    const json report = state(std::string(search.name) + ".json");
    EXPECT_TRUE(report["tab"] == search.panel || report["bottom_panel"] == search.panel) << search.text;
    EXPECT_TRUE(report["items"].contains(search.name)) << search.text;
  }
  EXPECT_NEAR(state("light.preset.json")["parameters"]["light.0.intensity"].get<double>(), 1 / 0.639, 0.01)
      << "1 cd, and 0.639 is the luminance of the colour";
  EXPECT_EQ(state("values.json")["parameters"]["view.aov"], "albedo");
  EXPECT_EQ(state("values.json")["lab"]["experiment"], "quadrature");
}

// A value that was chosen for a widget that is not on screen is not set when the widget appears later.
TEST(ItemRegistry, RequestsOfMarkedItemsEndWithTheMark) {
  viewer::ItemRegistry items;
  items.point_out("view.aov", "albedo");
  items.advance(0.1f);
  EXPECT_EQ(items.take_request("view.aov"), "albedo");
  items.point_out("view.aov", "albedo");
  items.advance(10);
  EXPECT_FALSE(items.take_request("view.aov"));
  items.request("view.aov", "depth");  // by a script
  items.advance(10);
  EXPECT_EQ(items.take_request("view.aov"), "depth");
}

// Arrow keys scroll the selected entry into view.
TEST_F(Viewer, ThePaletteShowsTheSelectedEntry) {
  json steps = json::array({key("ctrl+k"), {{"do", "wait"}, {"seconds", 0.2}}});
  for (int i = 0; i < 60; ++i) steps.push_back(key("down"));
  ASSERT_EQ(run(joined(steps, json::array(
                                  {file_step("state", path("s.json")), file_step("screenshot", path("palette.png"))}))),
            0);
  EXPECT_EQ(state("s.json")["palette_selection_is_visible"], true);
}

// A node is shown if its name or a descendant's contains the filter.
TEST_F(Viewer, FilterHidesOtherObjects) {
  const auto document = render::new_document("cornell");
  const auto& nodes = document->scene->nodes;
  const auto tall = std::ranges::find(nodes, "tall box", &scene::Node::name) - nodes.begin();
  ASSERT_LT(tall, std::ssize(nodes));
  const auto click_box = [&](const std::string& filter) {
    return json::array({click("tab.scene"), set("layout.filter", filter), click("scene.node." + std::to_string(tall))});
  };
  EXPECT_EQ(run(click_box("TALL")), 0);
  EXPECT_NE(run(click_box("short")), 0) << "a hidden object cannot be clicked";
}

TEST_F(Viewer, FilterOfMessages) {
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                             click("compare.pin"),
                             click("panel.messages"),
                             set("messages.filter", "\u017blah"),
                             file_step("screenshot", path("messages.png"))})),
            0);
}

// The button in the message leads to the parameter that is to be changed.
TEST_F(Viewer, TheReasonForABlackImageLeadsToItsParameter) {
  ASSERT_EQ(run(json::array({set("render.integrator", "light-pure"),
                             {{"do", "wait"}, {"seconds", 0.5}},
                             file_step("screenshot", path("reason.png")),
                             click("incompatibility.camera.lens-radius"),
                             {{"do", "wait"}, {"seconds", 0.2}},
                             file_step("state", path("s.json"))})),
            0);
  EXPECT_EQ(state("s.json")["tab"], "tab.camera");
}

TEST_F(Viewer, FilterHidesOtherParameters) {
  const auto click_roughness = [](const std::string& filter) {
    return json::array({set("material.0.roughness", 0.5), set("layout.filter", filter), click("material.0.roughness")});
  };
  EXPECT_NE(run(click_roughness("base colour")), 0) << "a hidden parameter cannot be clicked";
  EXPECT_EQ(run(click_roughness("roughness")), 0);
}

// Every bottom panel with parameters has a filter for them.
TEST_F(Viewer, FilterOfBottomPanelsHidesOtherParameters) {
  const std::pair<const char*, const char*> parameters[] = {{"panel.lab", "lab.seed"},
                                                            {"panel.techniques", "techniques.exposure"},
                                                            {"panel.radiosity", "patches.axis"},
                                                            {"panel.sampling", "sampling.points"},
                                                            {"panel.trace", "trace.sample"}};
  for (const auto& [panel, parameter] : parameters) {
    const auto click_parameter = [&](const std::string& filter) {
      return json::array(
          {set("render.integrator", "bdpt"), click(panel), set("layout.bottom-filter", filter), click(parameter)});
    };
    EXPECT_NE(run(click_parameter("no such text")), 0) << panel;
    const std::string name = parameter;
    EXPECT_EQ(run(click_parameter(name.substr(name.find('.')))), 0) << panel;
  }
}

TEST(Notices, WarningsOfAFileAreOneMessageAndAllAreInTheLog) {
  viewer::Notices notices;
  notices.add_warnings("a.glb", {"no texture 1", "no texture 2", "no texture 3"});
  ASSERT_EQ(notices.all().size(), 1u);
  EXPECT_TRUE(notices.all()[0].has_more);
  EXPECT_EQ(notices.log().size(), 3u);
  notices.close_all();
  EXPECT_EQ(notices.log().size(), 3u);
}

TEST(Notices, EqualMessagesAreCounted) {
  viewer::Notices notices;
  for (int i = 0; i < 3; ++i) notices.add_error("the file cannot be read");
  ASSERT_EQ(notices.all().size(), 1u);
  EXPECT_EQ(notices.all()[0].count, 3);
  EXPECT_EQ(notices.take_error(), "the file cannot be read");
}

// Crashes, failed assertions of Dear ImGui and hangs end the run; results are not checked.
TEST_F(Viewer, RandomUserDoesNoHarm) {
  const auto previous = fs::current_path();
  fs::current_path(folder_);
  const json steps = json::array({{{"do", "random"}, {"seed", 7}, {"actions", 200}, {"log", path("random.log")}}});
  EXPECT_EQ(run(steps, "", 1024, 600), 0);
  fs::current_path(previous);
}

}  // namespace
}  // namespace etendue::preferences_test
