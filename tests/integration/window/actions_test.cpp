// Every action of the program in a real window: by its shortcuts, by its entry in a menu, and by the palette if it has no
// entry. An action has to be enabled when it is chosen; where that needs another action first, it is listed here.
#include <algorithm>
#include <map>
#include <set>

#include "window_test.h"

namespace etendue::actions_test {
namespace {

// The actions of the program, from `etendue list widgets --json`.
const json& all_actions() {
  static const json actions = [] {
    FILE* pipe = popen((std::string(ETENDUE_BINARY) + " list widgets --json").c_str(), "r");
    std::string text;
    char block[4096];
    for (size_t n = 0; pipe && (n = fread(block, 1, sizeof block, pipe)) > 0;) text.append(block, n);
    if (pipe) pclose(pipe);
    json found = json::array();
    for (const auto& entry : json::parse(text))
      if (entry.contains("shortcut")) found.push_back(entry);
    return found;
  }();
  return actions;
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// "Ctrl+Shift+Z" in the notation of xdotool.
std::string xdotool_keys(std::string label) {
  const std::pair<const char*, const char*> names[] = {
      {"Ctrl+", "ctrl+"}, {"Shift+", "shift+"}, {"Alt+", "alt+"},      {"Space", "space"},    {"Enter", "Return"},
      {"Esc", "Escape"},  {"Page up", "Prior"}, {"Page down", "Next"}, {",", "comma"},        {".", "period"},
      {"-", "minus"},     {"=", "equal"},       {"[", "bracketleft"},  {"]", "bracketright"}, {"?", "question"}};
  for (const auto& [from, to] : names)
    if (const size_t at = label.find(from); at != std::string::npos) label.replace(at, std::string(from).size(), to);
  const size_t key = label.rfind('+') == std::string::npos ? 0 : label.rfind('+') + 1;
  if (label.size() - key == 1) label[key] = static_cast<char>(std::tolower(static_cast<unsigned char>(label[key])));
  return label;
}

// Actions that these tests do not choose, with the reason.
const std::set<std::string> kLeftOut{
    "app.quit",           // window.Window.QuittingAsksAboutUnsavedEdits
    "file.cancel",        // enabled only while a file is opened; no test chooses it
    "animation.play",     // viewer.FirstView.AnimationsPlayWithoutEditingTheScene
    "view.clear-region",  // viewer.Viewer.RegionReceivesTheSamplesUntilItIsCleared
    "animation.previous-frame",
    "animation.next-frame",  // viewer.Viewer.TimelineStepsByFramesAndChoosesClips
    "animation.range-start",
    "animation.range-end",
    "animation.clear-range",  // viewer.Sequence.AnimationHasTheFramesOfTheRange
    "compare.live-a",         // viewer.Snapshots.TwoOfThemAreComparedAsAAndB
    "sequence.stop",          // viewer.Sequence.StoppingKeepsCompleteImagesAndContinuesTheRendering
};

// What makes an action enabled in the Cornell box: other actions; "image", a click on a surface; "shift+image", another one;
// "parameter=value", a value that is typed.
const std::map<std::string, std::vector<std::string>> kPreparations{
    {"edit.undo", {"display.brighter"}},
    {"edit.redo", {"display.brighter", "edit.undo"}},
    {"edit.deselect", {"add.box"}},
    {"keyframe.set", {"add.box"}},
    {"keyframe.remove", {"add.box", "keyframe.set"}},
    {"layout.detach", {"view.panel.histogram"}},
    {"object.duplicate", {"add.box"}},
    {"object.delete", {"add.box"}},
    {"object.hide", {"add.box"}},
    {"light.solo", {"add.light.point"}},
    {"object.parent", {"add.box", "shift+image"}},
    {"object.unparent", {"add.box"}},
    {"material.duplicate", {"material.add"}},
    {"material.delete", {"material.add"}},
    {"material.copy", {"material.add"}},
    {"material.paste", {"material.add", "material.copy"}},
    {"material.assign", {"add.box", "material.add"}},
    {"material.save", {"material.add"}},
    {"render.previous", {"integrator.bdpt", "integrator.path"}},
    {"integrator.choose-again", {"integrator.auto"}},
    {"advice.stop", {"advice.ask"}},
    {"compare.swap", {"compare.split"}},
    {"compare.divider-left", {"compare.split"}},
    {"compare.divider-right", {"compare.split"}},
    {"compare.reference", {"compare.start"}},
    {"compare.stop", {"compare.start"}},
    {"compare.continue", {"compare.start", "compare.stop"}},
    {"compare.export", {"compare.start", "compare.stop"}},
    {"techniques.export", {"integrator.bdpt", "view.panel.techniques"}},
    {"techniques.all", {"integrator.bdpt", "bdpt.without=1,1"}},
    {"paths.all", {"film.paths=ES*L"}},
    {"surface.pin", {"view.panel.surface", "image"}},
    {"surface.unpin", {"view.panel.surface", "image", "surface.pin"}},
    {"view.unpin-pixel", {"image", "view.pin-pixel", "image"}},
    {"trace.export", {"integrator.path", "image", "trace.pick", "image"}},
    {"lab.export", {"view.panel.lab"}},
    {"messages.copy", {"compare.pin"}},
    {"messages.clear", {"compare.pin"}},
};

class Actions : public Window {
 protected:
  // A window in which no menu and no list is cut.
  void SetUp() override {
    Window::SetUp();
    if (user_) user_->resize(1600, 1400);
  }

  bool is_enabled(const std::string& action) {
    return std::ranges::count(user_->report()["enabled_actions"], json(action)) > 0;
  }

  bool becomes_enabled(const std::string& action, double seconds = 20) {
    return user_->wait_until(
        [&](const json& report) { return std::ranges::count(report["enabled_actions"], json(action)) > 0; }, seconds);
  }

  // Closes whatever an action has opened.
  void close_popups() {
    for (int i = 0; i < 2 && user_->report()["popup_open"] == true; ++i) user_->press("Escape");
    if (user_->has_item("unsaved.discard")) user_->click("unsaved.discard");
    if (!user_->has_item("menu.file")) user_->press("h");  // the interface was hidden
  }

  void run_by_palette(const std::string& action) {
    user_->press("ctrl+k");
    user_->type(action);
    user_->click("palette." + action);
  }

  void run_if_enabled(const std::string& action) {
    ASSERT_TRUE(becomes_enabled(action)) << action;
    run_by_palette(action);
    close_popups();
  }

  // The actions of panels close a panel that is open.
  bool is_open_panel(const std::string& action) {
    return action == "view." + user_->report()["bottom_panel"].get<std::string>();
  }

  // Beside the middle, where the divider of a comparison is.
  void click_image(double x = 0.3) {
    const json image = user_->report()["image"];
    user_->click_at(static_cast<int>(image[0].get<double>() + x * image[2].get<double>()),
                    static_cast<int>(image[1].get<double>() + 0.5 * image[3].get<double>()));
  }

  void enter(const std::string& parameter, const std::string& value) {
    run_by_palette(parameter);
    user_->click(parameter);
    user_->press("ctrl+a");
    user_->type(value);
    user_->press("Return");
  }

  void prepare(const std::string& action) {
    const auto found = kPreparations.find(action);
    if (found == kPreparations.end() || is_enabled(action)) return;
    for (const std::string& step : found->second) {
      if (step == "image")
        click_image();
      else if (step == "shift+image")
        user_->hold("shift", [&] { click_image(0.05); });
      else if (const size_t equals = step.find('='); equals != std::string::npos)
        enter(step.substr(0, equals), step.substr(equals + 1));
      else if (!is_open_panel(step))
        run_if_enabled(step);
      if (HasFatalFailure() || becomes_enabled(action, 3)) return;
    }
  }

  void run_by_menu(const json& action) {
    const std::string name = action["name"], submenu = lower_case(action["submenu"].get<std::string>());
    user_->click("menu." + lower_case(action["menu"].get<std::string>()));
    if (!submenu.empty()) user_->click("submenu." + submenu);
    user_->click("entry." + name);
  }
};

class ActionsOfMenu : public Actions, public ::testing::WithParamInterface<const char*> {};

TEST_P(ActionsOfMenu, EveryEntry) {
  int chosen = 0;
  for (const json& action : all_actions()) {
    const std::string name = action["name"];
    if (action["menu"] != GetParam() || kLeftOut.contains(name)) continue;
    prepare(name);
    if (HasFatalFailure()) return;
    if (!becomes_enabled(name)) {
      ADD_FAILURE() << name << " is disabled";
      continue;
    }
    run_by_menu(action);
    ++chosen;
    ASSERT_TRUE(user_->is_running()) << "after " << name;
    close_popups();
  }
  EXPECT_GT(chosen, 0);
}

INSTANTIATE_TEST_SUITE_P(Menus, ActionsOfMenu,
                         ::testing::Values("File", "Edit", "View", "Compare", "Integrator", "Render", "Help"),
                         [](const auto& name) { return std::string(name.param); });

// Each menu of an action is one of those above.
TEST(ActionsOfMenus, AllMenusAreTested) {
  const std::set<std::string> tested{"", "File", "Edit", "View", "Compare", "Integrator", "Render", "Help"};
  for (const json& action : all_actions())
    EXPECT_TRUE(tested.contains(action["menu"].get<std::string>())) << action["name"] << ": " << action["menu"];
}

TEST_F(Actions, WithoutMenuByPalette) {
  int chosen = 0;
  for (const json& action : all_actions()) {
    const std::string name = action["name"];
    if (action["menu"] != "" || kLeftOut.contains(name)) continue;
    prepare(name);
    if (HasFatalFailure()) return;
    if (!becomes_enabled(name)) {
      ADD_FAILURE() << name << " is disabled";
      continue;
    }
    run_by_palette(name);
    ++chosen;
    ASSERT_TRUE(user_->is_running()) << "after " << name;
    close_popups();
  }
  EXPECT_GT(chosen, 0);
}

TEST_F(Actions, EveryShortcut) {
  int pressed = 0;
  for (const auto& action : all_actions()) {
    if (action["name"] == "app.quit") continue;
    for (const auto& shortcut : action["shortcut"]) {
      user_->press(xdotool_keys(shortcut));
      ++pressed;
      ASSERT_TRUE(user_->is_running()) << "after " << action["name"] << ", " << shortcut;
      close_popups();
    }
  }
  EXPECT_GT(pressed, 25);
}

}  // namespace
}  // namespace etendue::actions_test
