// Every shortcut in a real window, with its effect on the state that the viewer reports.
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>

#include "actions.h"

namespace etendue::shortcuts_test {
namespace {

// Whether two reports, before and after a shortcut, show its effect.
using Effect = std::function<bool(const json& before, const json& now)>;

// A value of the report by its JSON pointer; null if there is none.
json value_at(const json& report, const std::string& pointer) {
  const json::json_pointer at(pointer);
  return report.contains(at) ? report[at] : json();
}

double number_at(const json& report, const std::string& pointer) {
  const json value = value_at(report, pointer);
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

Effect changes(const std::string& pointer) {
  return [=](const json& before, const json& now) { return value_at(before, pointer) != value_at(now, pointer); };
}
Effect becomes(const std::string& pointer, const json& value) {
  return [=](const json& before, const json& now) {
    return value_at(before, pointer) != value && value_at(now, pointer) == value;
  };
}
Effect increases(const std::string& pointer) {
  return [=](const json& before, const json& now) { return number_at(now, pointer) > number_at(before, pointer); };
}
Effect decreases(const std::string& pointer) {
  return [=](const json& before, const json& now) { return number_at(now, pointer) < number_at(before, pointer); };
}
Effect shows(const std::string& item) {
  return [=](const json& before, const json& now) {
    return !before["items"].contains(item) && now["items"].contains(item);
  };
}
Effect hides(const std::string& item) {
  return [=, shown = shows(item)](const json& before, const json& now) { return shown(now, before); };
}
Effect enables(const std::string& action) {
  const auto count = [=](const json& report) { return std::ranges::count(report["enabled_actions"], json(action)); };
  return [=](const json& before, const json& now) { return count(before) == 0 && count(now) == 1; };
}
Effect disables(const std::string& action) {
  return [=, enabled = enables(action)](const json& before, const json& now) { return enabled(now, before); };
}
Effect moves_the_camera() {
  return [](const json& before, const json& now) {
    return std::ranges::any_of(std::array{"x", "y", "z"}, [&](const std::string& axis) {
      return changes("/parameters/camera.eye." + axis)(before, now);
    });
  };
}

// Whether each object is visible, by the name of the parameter.
json visibility(const json& report) {
  json found = json::object();
  for (const auto& [name, value] : report["parameters"].items())
    if (name.starts_with("node.") && name.ends_with(".visible")) found[name] = value;
  return found;
}
bool adds_an_object(const json& before, const json& now) {
  return visibility(now).size() == visibility(before).size() + 1;
}
bool changes_visibility(const json& before, const json& now) {
  return visibility(before).size() == visibility(now).size() && visibility(before) != visibility(now);
}

bool saves_an_image(const json& before, const json& now) {
  const auto count = [](const json& report) {
    return std::ranges::count_if(report["log"],
                                 [](const json& text) { return text.get<std::string>().starts_with("Saved "); });
  };
  return count(now) > count(before);
}

struct Expectation {
  Effect effect;
  // Before the shortcut, beyond what enables the action.
  std::vector<std::string> steps{};
};

const Effect kOpensFileDialog = shows("files.accept");

// The shortcuts of a menu are pressed in the order of this list, which is that of the actions: later ones rely on the state
// that earlier ones have left.
const std::map<std::string, Expectation>& expectations() {
  static const std::map<std::string, Expectation> all{
      {"file.new", {becomes("/scene", "new")}},
      {"file.open", {kOpensFileDialog}},
      {"file.reload", {becomes("/undo_depth", 0), {"display.brighter"}}},
      {"session.save", {kOpensFileDialog}},
      {"session.save-as", {kOpensFileDialog}},
      {"snapshot.save", {saves_an_image}},
      {"snapshot.save-as", {kOpensFileDialog}},
      {"scene.save", {kOpensFileDialog}},
      {"app.preferences", {shows("preferences.close")}},
      {"edit.undo", {decreases("/undo_depth")}},
      {"edit.redo", {decreases("/redo_depth")}},
      {"edit.deselect", {becomes("/selection/node", -1)}},
      {"view.frame-all", {moves_the_camera()}},
      {"view.frame-selection", {moves_the_camera(), {"add.box"}}},
      {"view.reset-camera", {moves_the_camera()}},
      {"display.darker", {decreases("/parameters/camera.exposure")}},
      {"display.brighter", {increases("/parameters/camera.exposure")}},
      {"display.auto-exposure", {changes("/parameters/camera.exposure"), {"display.darker"}}},
      {"display.next-aov", {changes("/parameters/view.aov")}},
      {"display.toggle-denoised", {becomes("/parameters/view.aov", "denoised")}},
      {"display.toggle-false-color", {becomes("/parameters/view.false-color", true)}},
      {"animation.play", {changes("/parameters/scene.time")}},
      {"animation.previous-frame", {changes("/parameters/scene.time"), {"animation.play"}}},  // stops playing
      {"animation.next-frame", {changes("/parameters/scene.time")}},
      {"view.interface", {hides("menu.file")}},
      {"app.palette", {becomes("/popup_open", true)}},
      {"app.help", {shows("help.close")}},
      {"zoom.fit", {becomes("/zoom", 0), {"zoom.200"}}},
      {"zoom.100", {becomes("/zoom", 1)}},
      {"zoom.200", {becomes("/zoom", 2)}},
      {"zoom.in", {increases("/zoom")}},
      {"zoom.out", {decreases("/zoom")}},
      {"object.duplicate", {adds_an_object}},
      {"object.delete", {changes("/undo")}},
      {"object.hide", {changes_visibility}},
      {"object.parent", {changes("/undo")}},
      {"object.unparent", {changes("/undo")}},
      {"keyframe.set", {enables("keyframe.remove")}},
      {"keyframe.remove", {disables("keyframe.remove")}},
      {"gizmo.move", {shows("gizmo.y"), {"add.light.spot"}}},
      {"gizmo.rotate", {changes("/items/gizmo.y")}},
      {"gizmo.scale", {changes("/items/gizmo.y")}},
      {"gizmo.local", {changes("/items/gizmo.y"), {"gizmo.move"}}},  // the handles of scaling are always local
      {"render.pause", {becomes("/paused", true)}},
      {"render.restart", {decreases("/seconds"), {"render.pause"}}},  // continues
      {"view.region", {enables("edit.deselect"), {"key:Escape"}}},
      {"render.previous", {changes("/parameters/render.integrator")}},
      {"integrator.raycast", {becomes("/parameters/render.integrator", "raycast")}},
      {"integrator.whitted", {becomes("/parameters/render.integrator", "whitted")}},
      {"integrator.path-pure", {becomes("/parameters/render.integrator", "path-pure")}},
      {"integrator.path", {becomes("/parameters/render.integrator", "path")}},
      {"integrator.light", {becomes("/parameters/render.integrator", "light")}},
      {"integrator.bdpt", {becomes("/parameters/render.integrator", "bdpt")}},
      {"integrator.mlt", {becomes("/parameters/render.integrator", "mlt")}},
      {"integrator.photonmap", {becomes("/parameters/render.integrator", "photonmap")}},
      {"integrator.sppm", {becomes("/parameters/render.integrator", "sppm")}},
      {"view.pixel-values", {changes("/pixel_values")}},
      {"meter.pick", {enables("edit.deselect"), {"key:Escape"}}},
      {"layout.detach", {changes("/detached")}},
      {"compare.split", {becomes("/comparison/mode", "wipe")}},
      {"compare.swap", {becomes("/comparison/swapped", true)}},
      {"compare.divider-left", {decreases("/comparison/divider")}},
      {"compare.divider-right", {increases("/comparison/divider")}},
  };
  return all;
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

class ShortcutsOfMenu : public Actions, public ::testing::WithParamInterface<const char*> {
 protected:
  // The image of the present settings, which has rested: edits of the program itself are over.
  void wait_for_image() {
    user_->wait_until([](const json& report) { return report["samples"] > 0 && report["seconds"] > 1; });
  }

  void check(const std::string& action, const std::string& shortcut) {
    const Expectation& expected = expectations().at(action);
    prepare(action);
    if (!HasFatalFailure()) perform(expected.steps);
    if (HasFatalFailure()) return;
    ASSERT_TRUE(becomes_enabled(action)) << action << " is disabled";
    wait_for_image();
    const json before = user_->report();
    user_->press(xdotool_keys(shortcut));
    EXPECT_TRUE(user_->wait_until([&](const json& now) { return expected.effect(before, now); }))
        << action << " by " << shortcut;
    ASSERT_TRUE(user_->is_running()) << "after " << action << ", " << shortcut;
    close_popups();
  }
};

TEST_P(ShortcutsOfMenu, HaveTheirEffects) {
  int pressed = 0;
  for (const json& action : all()) {
    if (action["menu"] != GetParam() || left_out().contains(action["name"])) continue;
    for (const auto& shortcut : action["shortcut"]) {
      check(action["name"], shortcut);
      if (HasFatalFailure()) return;
      ++pressed;
    }
  }
  EXPECT_GT(pressed, 0);
}

INSTANTIATE_TEST_SUITE_P(Menus, ShortcutsOfMenu,
                         ::testing::Values("File", "Edit", "View", "Compare", "Integrator", "Render", "Help"),
                         [](const auto& name) { return std::string(name.param); });

// Each action that has a shortcut is in a menu, and its effect is known.
TEST(Shortcuts, AllOfThemAreTested) {
  for (const json& action : Actions::all()) {
    if (action["shortcut"].empty() || Actions::left_out().contains(action["name"])) continue;
    EXPECT_NE(action["menu"], "") << action["name"];
    EXPECT_TRUE(expectations().contains(action["name"])) << action["name"];
  }
}

}  // namespace
}  // namespace etendue::shortcuts_test
