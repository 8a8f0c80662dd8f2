// The viewer in a real window with a real pointer and keyboard: fields, checkboxes, lists, the viewport, the palette, and
// sizes from 800 x 600 to 2560 x 1440. Skipped without Xvfb or xdotool.
#include <cmath>

#include "window_test.h"

namespace etendue::campaign_test {
namespace {

TEST_F(Window, NumberField) {
  const std::string field = select_box() + ".roughness";
  const double original = parameter(field);
  user_->click(field, 1, 2);
  for (const char* keys : {"ctrl+a", "ctrl+c", "ctrl+v", "ctrl+a"}) user_->press(keys);
  user_->type("0.25");
  user_->press("Return");
  EXPECT_TRUE(becomes(field, 0.25)) << "a double click opens text input";
  user_->drag(field, 40, 0);
  EXPECT_TRUE(differs(field, 0.25)) << "a drag moves the slider";
  user_->hold("ctrl", [&] { user_->click(field); });
  EXPECT_TRUE(becomes(field, original)) << "Ctrl+click resets";
  user_->click(field, 1, 2);
  user_->press("Tab");
  user_->press("Escape");
  EXPECT_TRUE(becomes(field, original)) << "text input that is left without a change keeps the value";
  user_->scroll(field, -2);
  user_->scroll(field, 2);
  user_->drag(field, 30, 0);
  EXPECT_TRUE(differs(field, original));
  user_->press("ctrl+z");
  EXPECT_TRUE(becomes(field, original)) << "a drag is one step of undo";
}

TEST_F(Window, ContextMenuResetsAParameter) {
  const std::string field = select_box() + ".roughness";
  const double original = parameter(field);
  user_->drag(field, -60, 0);
  ASSERT_TRUE(differs(field, original));
  user_->click(field, 3);
  user_->click("menu.reset");
  EXPECT_TRUE(becomes(field, original));
}

TEST_F(Window, CheckboxComboTreeAndText) {
  user_->click("tab.scene");
  user_->click("scene.node.0.visible");
  EXPECT_TRUE(becomes("node.0.visible", false));
  user_->click("scene.node.6");
  EXPECT_TRUE(user_->wait_until([](const json& report) { return report["selection"]["node"] == 6; }));
  user_->click("scene.node.6", 3);
  user_->press("Escape");
  user_->click("tab.render");
  user_->click("render.integrator");
  user_->press("Escape");
  user_->click("layout.filter");
  user_->type("sampl");
  user_->click("layout.filter.clear");
  user_->click("tab.camera");
  user_->click("camera.focus-by-click");
}

// Drags a splitter, and resets it by a double click. `axis` is 0 for a splitter that moves in x, and 1 for one in y.
void check_splitter(test::WindowUser& user, const std::string& splitter, int axis, int by) {
  constexpr double kInGrip = 0.25;  // of its size
  const auto position = [&](const json& report) { return report["items"][splitter][axis].get<double>(); };
  user.move_to(splitter);
  const double original = position(user.report());
  user.drag_in(splitter, kInGrip, kInGrip, axis == 0 ? by : 0, axis == 1 ? by : 0);
  constexpr double kGrip = 6;  // pixels; the splitter jumps to the pointer
  EXPECT_TRUE(user.wait_until([&](const json& report) { return std::abs(position(report) - original - by) <= kGrip; }))
      << splitter << " follows the pointer";
  // Two clicks are a double click if they are at most 0.3 s apart, which slow frames may prevent.
  const auto is_reset = [&](const json& report) { return position(report) == original; };
  bool was_reset = false;
  for (int attempt = 0; attempt < 4 && !was_reset; ++attempt) {
    user.click_in(splitter, kInGrip, kInGrip, 1, 2);
    was_reset = user.wait_until(is_reset, 1);
  }
  EXPECT_TRUE(was_reset) << "a double click resets " << splitter;
}

TEST_F(Window, SplitterOfTheColumn) { check_splitter(*user_, "layout.column", 0, -60); }

TEST_F(Window, SplitterOfTheBottomPanel) {
  user_->click("panel.histogram");
  check_splitter(*user_, "layout.bottom-panel", 1, -40);
}

TEST_F(Window, PointerInTheViewport) {
  const json before = parameter("camera.eye.x");
  user_->press("Home");
  EXPECT_TRUE(user_->wait_until([&](const json& report) { return report["undo_depth"] > 0; }));
  user_->press("ctrl+z");
  EXPECT_TRUE(becomes("camera.eye.x", before));
}

TEST_F(Window, PaletteFindsAndRunsACommand) {
  user_->press("ctrl+k");
  user_->type("light meter");
  user_->press("Escape");
  user_->press("ctrl+k");
  user_->type("tone neutral");
  user_->press("Return");
  EXPECT_TRUE(becomes("display.curve", "neutral"));
}

TEST_F(Window, SizesFromSmallToLarge) {
  for (const auto& [width, height] : {std::pair{800, 600}, {1024, 600}, {1280, 720}, {1920, 1080}, {2560, 1440}}) {
    user_->resize(width, height);
    user_->press("F1");
    const auto is_open = [](const json& report) { return report["items"].contains("help.close"); };
    ASSERT_TRUE(user_->wait_until(is_open)) << width << " x " << height;
    const json items = user_->report()["items"];
    const auto end = [&](const char* item, size_t axis) {
      return items[item][axis].get<double>() + items[item][axis + 2].get<double>();
    };
    EXPECT_LE(end("help.content", 0), end("help.list", 0)) << "the list of shortcuts fits the width " << width;
    if (height > 600) {  // the virtual display enlarges the interface to 125 %
      EXPECT_LE(end("help.content", 1), end("help.list", 1)) << "and the height " << height;
    }
    EXPECT_LE(end("help.list", 0), width);
    EXPECT_LE(end("help.list", 1), height);
    user_->press("F1");
    user_->click("panel.convergence");
    user_->click("panel.convergence");
  }
}

TEST_F(Window, QuittingAsksAboutUnsavedEdits) {
  user_->drag(select_box() + ".roughness", -60, 0);
  user_->press("ctrl+q");
  user_->click("unsaved.cancel");
  EXPECT_TRUE(user_->is_running());
  user_->press("ctrl+q");
  user_->move_to("unsaved.discard");
  has_ended_ = true;
  try {
    user_->click("unsaved.discard");
  } catch (const std::exception&) {
    // The window is gone before the pointer has been released.
  }
  EXPECT_EQ(user_->wait_for_exit(), 0);
}

}  // namespace
}  // namespace etendue::campaign_test
