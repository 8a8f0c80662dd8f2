// Widgets with more than one part, dialogs, and files that are dropped, in a real window with a real pointer and keyboard.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "file_drag.h"
#include "window_test.h"

namespace etendue::widgets_test {
namespace {

class Widgets : public Window {
 protected:
  // Shows a material that is chosen from the list of the Material panel.
  void choose_material(int index) {
    const std::string number = std::to_string(index);
    user_->click("tab.material");
    user_->click("material.choose");
    user_->click("material.choose." + number);
    EXPECT_TRUE(user_->wait_until([&](const json& report) { return report["selection"]["material"] == index; }));
  }

  bool becomes_number(const std::string& name, double value, double tolerance = 1e-6) {
    return user_->wait_until([&](const json& report) {
      const json& parameter = report["parameters"][name];
      return parameter.is_number() && std::abs(parameter.get<double>() - value) <= tolerance;
    });
  }

  int undo_depth() { return user_->report()["undo_depth"].get<int>(); }
  bool shows_scene(const std::string& name) {
    return user_->wait_until([&](const json& report) { return report["scene"].get<std::string>().ends_with(name); },
                             60);
  }

  // A scene in the folder of the test, written by the command line.
  fs::path saved_scene(const std::string& scene, const std::string& name) {
    const fs::path file = folder_ / name;
    const std::string command = std::string("'") + ETENDUE_BINARY + "' save " + scene + " -o '" + file.string() + "'";
    EXPECT_EQ(std::system((command + " >/dev/null 2>&1").c_str()), 0) << command;
    return file;
  }
};

TEST_F(Widgets, ComboEntryIsChosen) {
  user_->click("tab.render");
  user_->click("render.integrator");
  user_->click("render.integrator=bdpt");
  EXPECT_TRUE(becomes("render.integrator", "bdpt"));
  user_->click("render.integrator");
  user_->press("Escape");
  EXPECT_TRUE(becomes("render.integrator", "bdpt")) << "Escape keeps the value";
  user_->press("ctrl+z");
  EXPECT_TRUE(differs("render.integrator", "bdpt")) << "a choice is one step of undo";
}

TEST_F(Widgets, VectorField) {
  user_->resize(1280, 1000);
  user_->click("tab.camera");
  const std::string field = "camera.eye.y";
  const json original = parameter(field), other = parameter("camera.eye.x");
  user_->drag(field, 40, 0);
  EXPECT_TRUE(differs(field, original)) << "a drag changes the component";
  EXPECT_EQ(parameter("camera.eye.x"), other);
  user_->click(field, 1, 2);
  user_->press("ctrl+a");
  user_->type("0.75");
  user_->press("Return");
  EXPECT_TRUE(becomes_number(field, 0.75)) << "a double click opens text input";
  user_->hold("ctrl", [&] { user_->click(field); });
  EXPECT_TRUE(becomes(field, original)) << "Ctrl+click resets";
}

TEST_F(Widgets, HexValueIsTyped) {
  const std::string color = select_box() + ".base-color";
  user_->click_in(color, 0.3, 0.5);
  user_->press("ctrl+a");
  user_->type("3366CC");
  user_->press("Return");
  // #3366CC in linear values.
  EXPECT_TRUE(becomes_number(color + ".r", 0.0331, 1e-4));
  EXPECT_TRUE(becomes_number(color + ".g", 0.1329, 1e-4));
  EXPECT_TRUE(becomes_number(color + ".b", 0.6038, 1e-4));
}

// The swatch is at the right end of the field; its picker opens below, as far to the left as the window requires.
TEST_F(Widgets, SwatchOpensAPicker) {
  const std::string color = select_box() + ".base-color";
  user_->resize(1280, 1400);
  const json before = user_->report()["parameters"];
  const int depth = undo_depth();
  user_->click_in(color, 0.97, 0.5);
  const json field = user_->report()["items"][color];
  const int x = static_cast<int>(field[0].get<double>() + field[2].get<double>()) - 170;
  const int y = static_cast<int>(field[1].get<double>() + field[3].get<double>()) + 80;
  user_->drag_at(x, y, 20, 30);
  EXPECT_TRUE(user_->wait_until([&](const json& report) {
    const json& now = report["parameters"];
    return now[color + ".r"] != before[color + ".r"] || now[color + ".g"] != before[color + ".g"] ||
           now[color + ".b"] != before[color + ".b"];
  }));
  user_->press("Escape");
  EXPECT_EQ(undo_depth(), depth + 1) << "a drag in the picker is one step";
  user_->press("ctrl+z");
  for (const char* component : {".r", ".g", ".b"}) EXPECT_TRUE(becomes(color + component, before[color + component]));
}

TEST_F(Widgets, SwatchOfARadiance) {
  user_->resize(1280, 1400);
  choose_material(3);
  const std::string color = "material.3.emission";
  const json before = parameter(color + ".b");
  user_->click(color);
  user_->click_in(color + ".picker", 0.3, 0.3);
  EXPECT_TRUE(differs(color + ".b", before));
  user_->press("Escape");
  user_->press("ctrl+z");
  EXPECT_TRUE(becomes(color + ".b", before));
}

TEST_F(Widgets, SpectrumEditor) {
  user_->resize(1280, 1400);
  choose_material(3);
  const std::string spectrum = "material.3.emission-spectrum", chart = spectrum + ".points";
  user_->click(spectrum + ".edit");
  ASSERT_TRUE(user_->wait_until([&](const json& report) { return report["items"].contains(chart); }));
  const auto count = [&](const json& report) {
    const auto text = report["parameters"][spectrum].get<std::string>();
    return std::ranges::count(text, ':');
  };
  const auto points = count(user_->report());
  ASSERT_GE(points, 2);
  // Two clicks are a double click if they are at most 0.3 s apart, which slow frames may prevent.
  const auto has_added = [&](const json& report) { return count(report) == points + 1; };
  for (int attempt = 0; attempt < 4 && !user_->wait_until(has_added, 1); ++attempt)
    user_->click_in(chart, 0.503, 0.8, 1, 2);
  ASSERT_TRUE(user_->wait_until(has_added)) << "a double click adds a point";
  const json added = parameter(spectrum);
  user_->drag_in(chart, 0.503, 0.8, 0, -30);
  EXPECT_TRUE(differs(spectrum, added)) << "a drag moves the point";
  user_->press("ctrl+z");
  EXPECT_TRUE(becomes(spectrum, added)) << "a drag is one step of undo";
  user_->click_in(chart, 0.503, 0.8, 3);
  EXPECT_TRUE(user_->wait_until([&](const json& report) { return count(report) == points; }))
      << "a right click removes the point";
}

TEST_F(Widgets, GizmoMovesAnObject) {
  user_->click("menu.edit");
  user_->click("submenu.add shape");
  user_->click("entry.add.box");
  ASSERT_TRUE(user_->wait_until([](const json& report) { return report["selection"]["node"] >= 0; }));
  const std::string node = "node." + std::to_string(user_->report()["selection"]["node"].get<int>()) + ".translation.";
  user_->press("g");
  const json before = user_->report()["parameters"];
  const int depth = undo_depth();
  user_->drag("gizmo.y", 2, -60);
  EXPECT_TRUE(user_->wait_until([&](const json& report) {
    return report["parameters"][node + "y"].get<double>() > before[node + "y"].get<double>();
  })) << "up on screen is up in the scene";
  for (const char* axis : {"x", "z"}) EXPECT_EQ(parameter(node + axis), before[node + axis]) << axis;
  EXPECT_EQ(undo_depth(), depth + 1) << "a drag is one step of undo";
  user_->press("ctrl+z");
  EXPECT_TRUE(becomes(node + "y", before[node + "y"]));
}

TEST_F(Widgets, PreferencesScaleAndShortcuts) {
  user_->press("ctrl+comma");
  user_->click("preferences.theme");
  user_->click("preferences.theme=light");
  user_->click("preferences.scale");
  user_->click("preferences.scale=1.25");
  EXPECT_TRUE(user_->wait_until([](const json& report) { return report["ui_scale"] == 1.25; }));
  user_->click("preferences.keyboard");
  user_->click("preferences.shortcut.file.cornell-spheres");
  user_->press("ctrl+j");
  user_->click("preferences.close");
  EXPECT_FALSE(user_->has_item("preferences.close"));
  user_->press("ctrl+j");
  EXPECT_TRUE(shows_scene("cornell-spheres")) << "the new shortcut works";
}

TEST_F(Widgets, WelcomePageOpensABuiltInScene) {
  user_->click("menu.help");
  user_->click("entry.app.welcome");
  user_->click("welcome.glass-caustic");
  EXPECT_TRUE(shows_scene("glass-caustic"));
  EXPECT_FALSE(user_->has_item("welcome.close"));
  user_->click("menu.help");
  user_->click("entry.app.welcome");
  user_->click("welcome.close");
  EXPECT_FALSE(user_->has_item("welcome.close"));
}

TEST_F(Widgets, DroppedFilesAreOpened) {
  if (!test::can_drag_files()) GTEST_SKIP() << "libx11-dev is not installed";
  const fs::path spheres = saved_scene("cornell-spheres", "Spheres of \u00c9tendue, 100 %.glb");
  user_->drop({spheres});
  EXPECT_TRUE(shows_scene(spheres.filename().string())) << "names with spaces and letters beyond ASCII";
  const fs::path sunset = saved_scene("sunset", "sunset.hdr");
  user_->drop({sunset});
  EXPECT_TRUE(user_->wait_until(
      [](const json& report) { return std::ranges::count(report["log"], json("Environment map: sunset.hdr")) == 1; }));
  EXPECT_EQ(user_->report()["errors"], json::array());

  // What cannot be opened leaves the scene, and says so.
  const fs::path broken = folder_ / "broken.glb";
  std::ofstream(broken) << "glTF, but not really";
  user_->drop({broken});
  EXPECT_TRUE(user_->wait_until([](const json& report) { return report["errors"].size() == 1; }));
  EXPECT_TRUE(shows_scene(spheres.filename().string()));
}

TEST_F(Widgets, DroppedSceneAsksAboutUnsavedEdits) {
  if (!test::can_drag_files()) GTEST_SKIP() << "libx11-dev is not installed";
  const fs::path spheres = saved_scene("cornell-spheres", "spheres.glb");
  user_->drag(select_box() + ".roughness", -60, 0);
  user_->drop({spheres});
  user_->click("unsaved.cancel");
  EXPECT_TRUE(shows_scene("cornell"));
  user_->drop({spheres});
  user_->click("unsaved.discard");
  EXPECT_TRUE(shows_scene("spheres.glb"));
}

}  // namespace
}  // namespace etendue::widgets_test
