// The tour of docs/guide/first-steps.md, step by step in a real window: it ends without an error
// and without a warning.
#include <cmath>

#include "window_test.h"

namespace etendue::tour_test {
namespace {

class Tour : public Window {
 protected:
  std::string selected_material() {
    return "material." + std::to_string(user_->report()["selection"]["material"].get<int>());
  }
  bool becomes_number(const std::string& name, double value) {
    constexpr double kRounding = 1e-6;  // of single precision
    return user_->wait_until(
        [&](const json& report) { return std::abs(report["parameters"][name].get<double>() - value) < kRounding; });
  }
  // The messages that are not confirmations of what the user did.
  std::vector<std::string> warnings() {
    std::vector<std::string> found;
    const json report = user_->report();
    for (const std::string message : report["log"]) {
      const bool is_confirmation = message.starts_with("Saved ") || message.starts_with("Pinned as B") ||
                                   message.starts_with("Integrator chosen automatically");
      if (!is_confirmation) found.push_back(message);
    }
    return found;
  }
  // Replaces the value of a number field by typing.
  void enter(const std::string& field, const std::string& value) {
    user_->click(field, 1, 2);
    user_->press("ctrl+a");
    user_->type(value);
    user_->press("Return");
  }
};

TEST_F(Tour, FiveMinutesInTheWindow) {
  // 1. Look around.
  const json eye = parameter("camera.eye.x");
  user_->drag_at(300, 300, 120, 20);
  EXPECT_TRUE(differs("camera.eye.x", eye));
  user_->press("Home");
  // The tall box is in the same place again.
  for (int i = 0; i < 2; ++i) user_->press("ctrl+z");
  EXPECT_TRUE(becomes("camera.eye.x", eye));

  // 2. Edit a material.
  user_->click_at(390, 420);
  ASSERT_TRUE(user_->wait_until([](const json& report) { return report["selection"]["material"] >= 0; }));
  const std::string material = selected_material();
  enter(material + ".metallic", "1");
  enter(material + ".roughness", "0.2");
  EXPECT_TRUE(becomes_number(material + ".metallic", 1));
  EXPECT_TRUE(becomes_number(material + ".roughness", 0.2));
  user_->press("ctrl+z");
  EXPECT_TRUE(becomes_number(material + ".roughness", 1));

  // 3. Switch the integrator. Each of them finds light in this view.
  for (const char* key : {"1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
    user_->press(key);
    EXPECT_TRUE(user_->wait_until([](const json& report) { return report["samples"] > 0; }, 60)) << "key " << key;
  }
  user_->press("4");
  user_->press("Tab");
  EXPECT_TRUE(becomes("render.integrator", "sppm"));
  user_->press("Tab");
  EXPECT_TRUE(becomes("render.integrator", "path"));

  // 4. Understand the noise.
  user_->press("bracketleft");
  EXPECT_TRUE(becomes_number("camera.exposure", -0.5));
  user_->press("bracketright");
  EXPECT_TRUE(becomes_number("camera.exposure", 0));
  user_->press("l");
  EXPECT_TRUE(becomes("view.false-color", true));
  user_->press("l");
  for (int i = 0; i < 3; ++i) user_->press("v");
  EXPECT_TRUE(differs("view.aov", "picture"));

  // 5. Compare.
  user_->click("panel.convergence");
  enter("compare.seconds", "1");
  enter("compare.repeats", "2");
  user_->click("compare.start");
  EXPECT_TRUE(user_->wait_until([](const json& report) { return report["contest"]["running"] == true; }));
  EXPECT_TRUE(user_->wait_until([](const json& report) { return report["contest"]["running"] == false; }, 240));
  EXPECT_TRUE(user_->wait_until([](const json& report) { return report["comparison"]["mode"] == "wipe"; }));
  user_->press("x");
  EXPECT_TRUE(user_->wait_until([](const json& report) { return report["comparison"]["swapped"] == true; }));
  user_->press("c");
  EXPECT_TRUE(user_->wait_until([](const json& report) { return report["comparison"]["mode"] == "off"; }));
  user_->click("panel.convergence");

  // 6. Ask for advice.
  user_->click("tab.render");
  user_->click("layout.filter");
  user_->type("limit");
  enter("render.error", "0.02");
  user_->click("layout.filter.clear");
  user_->click("menu.render");
  user_->click("advice.ask");
  EXPECT_TRUE(user_->wait_until([](const json& report) { return report["advice"]["fresh"] == true; }, 240));

  // 7. Save.
  user_->press("ctrl+s");
  user_->click("files.name");
  user_->press("ctrl+a");
  user_->type((folder_ / "tour.etendue").string());
  user_->press("Return");
  EXPECT_TRUE(user_->wait_until([&](const json&) { return fs::exists(folder_ / "tour.etendue"); }));
  EXPECT_EQ(user_->report()["errors"], json::array());
  EXPECT_EQ(warnings(), std::vector<std::string>());
}

}  // namespace
}  // namespace etendue::tour_test
