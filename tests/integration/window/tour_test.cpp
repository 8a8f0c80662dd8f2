// The tour of docs/guide/first-steps.md, step by step in a real window: it ends without an error and without a warning.
#include <algorithm>
#include <cmath>

#include "file_drag.h"
#include "window_test.h"

namespace etendue::tour_test {
namespace {

class Tour : public Window {
 protected:
  // The steps of the tour.
  void look_around() {
    start_ = place_of_camera();
    constexpr int kMiddle = 2, kRight = 3;  // buttons
    expect_move("orbit", [&] { user_->drag_at(300, 300, 120, 20); });
    expect_move("pan", [&] { user_->drag_at(300, 300, 60, 20, kMiddle); });
    expect_move("dolly", [&] { user_->scroll_at(300, 300, 2); });
    expect_move("fly",
                [&] { user_->hold_button(kRight, 300, 300, [&] { user_->hold("w", [&] { user_->settle(); }); }); });
    expect_move("frame", [&] { user_->press("Home"); });
    // The tall box is in the same place again.
    constexpr int kSteps = 12;
    for (int i = 0; i < kSteps && place_of_camera() != start_; ++i) user_->press("ctrl+z");
    EXPECT_EQ(place_of_camera(), start_);
  }

  void edit_a_material() {
    user_->click_at(390, 420);
    ASSERT_TRUE(user_->wait_until([](const json& report) { return report["selection"]["material"] >= 0; }));
    material_ = selected_material();
    expect_move("frame the selection", [&] { user_->press("f"); });
    user_->press("ctrl+z");
    EXPECT_TRUE(user_->wait_until([&](const json&) { return place_of_camera() == start_; }));
    enter(material_ + ".metallic", "1");
    enter(material_ + ".roughness", "0.2");
    EXPECT_TRUE(becomes_number(material_ + ".metallic", 1));
    EXPECT_TRUE(becomes_number(material_ + ".roughness", 0.2));
    user_->press("ctrl+z");
    EXPECT_TRUE(becomes_number(material_ + ".roughness", 1));
  }

  // Each integrator finds light in this view.
  void switch_the_integrator() {
    for (const char* key : {"1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
      user_->press(key);
      EXPECT_TRUE(user_->wait_until([](const json& report) { return report["samples"] > 0; }, 60)) << "key " << key;
    }
    user_->press("4");
    user_->press("Tab");
    EXPECT_TRUE(becomes("render.integrator", "sppm"));
    user_->press("Tab");
    EXPECT_TRUE(becomes("render.integrator", "path"));
  }

  void understand_the_noise() {
    user_->press("bracketleft");
    EXPECT_TRUE(becomes_number("camera.exposure", -0.5));
    user_->press("bracketright");
    EXPECT_TRUE(becomes_number("camera.exposure", 0));
    user_->press("l");
    EXPECT_TRUE(becomes("view.false-color", true));
    user_->press("l");
    for (int i = 0; i < 3; ++i) user_->press("v");
    EXPECT_TRUE(differs("view.aov", "picture"));
    // After the last AOV follows the image again.
    constexpr int kMaxLayers = 60;
    for (int i = 0; i < kMaxLayers && parameter("view.aov") != "picture"; ++i) user_->press("v");
    EXPECT_EQ(parameter("view.aov"), "picture");
  }

  void compare() {
    user_->click("panel.convergence");
    enter("compare.seconds", "1");
    enter("compare.repeats", "2");
    user_->click("compare.start");
    EXPECT_TRUE(user_->wait_until([](const json& report) { return report["contest"]["running"] == true; }));
    EXPECT_TRUE(user_->wait_until([](const json& report) { return report["contest"]["running"] == false; }, 240));
    EXPECT_TRUE(user_->wait_until([](const json& report) { return report["comparison"]["mode"] == "wipe"; }));
    use_divider_and_reference();
    user_->press("c");
    EXPECT_TRUE(user_->wait_until([](const json& report) { return report["comparison"]["mode"] == "off"; }));
    user_->click("panel.convergence");
  }

  void use_divider_and_reference() {
    const json first = user_->report()["comparison"]["a"];
    user_->click("compare.a.1");
    EXPECT_TRUE(user_->wait_until([&](const json& report) { return report["comparison"]["a"] != first; }));
    user_->click("compare.b.0");
    EXPECT_TRUE(user_->wait_until([&](const json& report) { return report["comparison"]["b"] == first; }));
    const double divider = user_->report()["comparison"]["divider"];
    user_->drag("compare.divider", -80, 0);
    EXPECT_TRUE(user_->wait_until(
        [&](const json& report) { return report["comparison"]["divider"].get<double>() < divider - 0.05; }));
    user_->press("x");
    EXPECT_TRUE(user_->wait_until([](const json& report) { return report["comparison"]["swapped"] == true; }));
    user_->hold("shift", [&] { EXPECT_TRUE(shows_reference(true)); });
    EXPECT_TRUE(shows_reference(false));
  }

  void follow_advice() {
    user_->press("3");
    EXPECT_TRUE(becomes("render.integrator", "path-pure"));
    user_->click("tab.render");
    enter_filtered("render.error", "limit", "0.02");
    enter_filtered("advice.pilot", "pilot", "0.2");
    user_->click("menu.render");
    user_->click("entry.advice.ask");
    EXPECT_TRUE(user_->wait_until([](const json& report) { return report["advice"]["running"] == true; }));
    EXPECT_TRUE(user_->wait_until([](const json& report) { return report["advice"]["running"] == false; }, 80));
    const auto method = user_->report()["advice"]["best"].get<std::string>();
    integrator_ = method.substr(0, method.find_first_of(":,"));
    EXPECT_NE(integrator_, "path-pure");
    user_->click("advice.use.0");
    EXPECT_TRUE(becomes("render.integrator", integrator_));
    EXPECT_TRUE(becomes_number("render.error", 0.02));
  }

  void save() {
    user_->press("F12");
    EXPECT_TRUE(user_->wait_until([&](const json& report) { return is_saved(report, snapshot()); }));
    user_->press("ctrl+s");
    user_->click("files.name");
    user_->press("ctrl+a");
    user_->type(session().string());
    user_->press("Return");
    EXPECT_TRUE(user_->wait_until([&](const json& report) { return is_saved(report, session()); }));
  }

  void drop_what_was_saved() {
    for (const fs::path& file : {snapshot(), session()}) {
      user_->press("bracketright");
      EXPECT_TRUE(becomes_number("camera.exposure", 0.5));
      user_->drop({file});
      EXPECT_TRUE(becomes_number("camera.exposure", 0)) << file << " restores the parameters";
      EXPECT_TRUE(becomes_number(material_ + ".metallic", 1)) << file << " restores the edits of the scene";
      EXPECT_TRUE(becomes("render.integrator", integrator_)) << file;
    }
  }

  // The messages that do not confirm what the user did: a file that was saved, an image that became B, a preference that is
  // on at the first start.
  std::vector<std::string> warnings() {
    constexpr const char* kConfirmations[] = {"Saved ", "Pinned as B: ", "Integrator chosen automatically: "};
    std::vector<std::string> found;
    const json report = user_->report();
    for (const std::string message : report["log"])
      if (std::ranges::none_of(kConfirmations, [&](const char* start) { return message.starts_with(start); }))
        found.push_back(message);
    return found;
  }

 private:
  std::string selected_material() {
    return "material." + std::to_string(user_->report()["selection"]["material"].get<int>());
  }
  bool becomes_number(const std::string& name, double value) {
    constexpr double kRounding = 1e-6;  // of single precision
    return user_->wait_until(
        [&](const json& report) { return std::abs(report["parameters"][name].get<double>() - value) < kRounding; });
  }
  json place_of_camera() { return {parameter("camera.eye.x"), parameter("camera.eye.y"), parameter("camera.eye.z")}; }
  void expect_move(const char* how, const std::function<void()>& action) {
    const json before = place_of_camera();
    action();
    EXPECT_TRUE(user_->wait_until([&](const json&) { return place_of_camera() != before; })) << how;
  }
  bool shows_reference(bool shows) {
    return user_->wait_until([&](const json& report) { return report["comparison"]["reference_on_screen"] == shows; });
  }
  static bool is_saved(const json& report, const fs::path& file) {
    return std::ranges::count(report["log"], json("Saved " + file.string())) > 0;
  }
  fs::path session() const { return folder_ / "tour.etendue"; }
  // The image that F12 has saved; empty if there is none.
  fs::path snapshot() const {
    const fs::path snapshots = folder_ / ".local/state/etendue/snapshots";
    if (!fs::is_directory(snapshots)) return {};
    for (const auto& entry : fs::directory_iterator(snapshots)) {
      const bool is_complete = !entry.path().filename().string().starts_with('.');
      if (is_complete && entry.path().extension() == ".exr") return entry.path();
    }
    return {};
  }
  // Replaces the value of a number field by typing.
  void enter(const std::string& field, const std::string& value) {
    user_->click(field, 1, 2);
    user_->press("ctrl+a");
    user_->type(value);
    user_->press("Return");
  }
  // The same for a field that a filter of the panel brings on screen.
  void enter_filtered(const std::string& field, const std::string& filter, const std::string& value) {
    user_->click("layout.filter");
    user_->type(filter);
    enter(field, value);
    user_->click("layout.filter.clear");
  }

  json start_;              // the position of the camera
  std::string material_;    // of the tall box: "material.5"
  std::string integrator_;  // that was recommended
};

TEST_F(Tour, FiveMinutesInTheWindow) {
  look_around();
  edit_a_material();
  if (HasFatalFailure()) return;
  switch_the_integrator();
  understand_the_noise();
  compare();
  follow_advice();
  save();
  if (test::can_drag_files()) drop_what_was_saved();
  EXPECT_EQ(user_->report()["errors"], json::array());
  EXPECT_EQ(warnings(), std::vector<std::string>());
}

}  // namespace
}  // namespace etendue::tour_test
