#include "actions.h"

#include <algorithm>
#include <map>

namespace etendue {
namespace {

// An object that moves from one keyframe to another.
const std::vector<std::string> kKeyframes{"add.box", "keyframe.set", "item:timeline.time", "keyframe.set"};

std::vector<std::string> keyframes_and(const std::string& step) {
  auto steps = kKeyframes;
  steps.push_back(step);
  return steps;
}

// What makes an action enabled in the Cornell box.
const std::map<std::string, std::vector<std::string>> kPreparations{
    {"edit.undo", {"display.brighter"}},
    {"edit.redo", {"display.brighter", "edit.undo"}},
    {"edit.deselect", {"add.box"}},
    {"keyframe.set", {"add.box"}},
    {"keyframe.remove", {"add.box", "keyframe.set"}},
    {"animation.play", kKeyframes},
    {"animation.previous-frame", kKeyframes},
    {"animation.next-frame", kKeyframes},
    {"animation.range-start", kKeyframes},
    {"animation.range-end", kKeyframes},
    {"animation.clear-range", keyframes_and("animation.range-start")},
    {"layout.detach", {"view.panel.histogram"}},
    {"object.duplicate", {"add.box"}},
    {"object.delete", {"add.box"}},
    {"object.hide", {"add.box"}},
    {"light.solo", {"add.light.point"}},
    {"object.parent", {"add.box", "shift+image"}},
    {"object.unparent", {"add.box", "shift+image", "object.parent"}},
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
    {"compare.live-a", {"compare.start"}},
    {"sequence.stop", {"sequence.start", "save:sequence.####.png"}},
    {"techniques.export", {"integrator.bdpt", "view.panel.techniques"}},
    {"techniques.all", {"integrator.bdpt", "bdpt.without=1,1"}},
    {"paths.all", {"film.paths=ES*L"}},
    {"surface.pin", {"view.panel.surface", "image"}},
    {"surface.unpin", {"view.panel.surface", "image", "surface.pin"}},
    {"view.clear-region", {"region", "view.region", "region"}},  // the tool may be active
    {"view.unpin-pixel", {"image", "view.pin-pixel", "image"}},
    {"trace.export", {"integrator.path", "image", "trace.pick", "image"}},
    {"lab.export", {"view.panel.lab"}},
    {"messages.copy", {"compare.pin"}},
    {"messages.clear", {"compare.pin"}},
};

json actions_of_the_program() {
  FILE* pipe = popen((std::string(ETENDUE_BINARY) + " list widgets --json").c_str(), "r");
  std::string text;
  char block[4096];
  for (size_t n = 0; pipe && (n = fread(block, 1, sizeof block, pipe)) > 0;) text.append(block, n);
  if (pipe) pclose(pipe);
  json found = json::array();
  for (const auto& entry : json::parse(text))
    if (entry.contains("shortcut")) found.push_back(entry);
  return found;
}

}  // namespace

const json& Actions::all() {
  static const json actions = actions_of_the_program();
  return actions;
}

const std::set<std::string>& Actions::left_out() {
  static const std::set<std::string> names{
      "app.quit",     // window.Window.QuittingAsksAboutUnsavedEdits
      "file.cancel",  // window.Actions.OpeningIsCancelled
  };
  return names;
}

void Actions::SetUp() {
  Window::SetUp();
  if (user_) user_->resize(1600, 1400);
}

bool Actions::is_enabled(const json& report, const std::string& action) {
  return std::ranges::count(report["enabled_actions"], json(action)) > 0;
}

bool Actions::becomes_enabled(const std::string& action, double seconds) {
  return user_->wait_until([&](const json& report) { return is_enabled(report, action); }, seconds);
}

void Actions::close_popups() {
  for (int i = 0; i < 2 && user_->report()["popup_open"] == true; ++i) user_->press("Escape");
  if (user_->has_item("unsaved.discard")) user_->click("unsaved.discard");
  if (!user_->has_item("menu.file")) user_->press("h");  // the interface was hidden
}

void Actions::run_by_palette(const std::string& action) {
  user_->press("ctrl+k");
  user_->type(action);
  user_->click("palette." + action);
}

void Actions::prepare(const std::string& action) {
  const auto found = kPreparations.find(action);
  if (found == kPreparations.end() || is_enabled(user_->report(), action)) return;
  for (const std::string& step : found->second) {
    perform_step(step);
    if (HasFatalFailure() || becomes_enabled(action, 1)) return;
  }
}

void Actions::perform(const Steps& steps) {
  for (const std::string& step : steps) {
    perform_step(step);
    if (HasFatalFailure()) return;
  }
}

void Actions::perform_step(const std::string& step) {
  const size_t colon = step.find(':'), equals = step.find('=');
  const std::string kind = step.substr(0, colon == std::string::npos ? 0 : colon), rest = step.substr(colon + 1);
  if (step == "image")
    click_image(0.3);  // beside the middle, where the divider of a comparison is
  else if (step == "shift+image")
    user_->hold("shift", [&] { click_image(0.05); });
  else if (step == "region")
    drag_in_image();
  else if (kind == "item")
    user_->click(rest);
  else if (kind == "key")
    user_->press(rest);
  else if (kind == "save")
    save_as(rest);
  else if (equals != std::string::npos)
    enter(step.substr(0, equals), step.substr(equals + 1));
  else if (!is_open_panel(step))
    run_if_enabled(step);
}

void Actions::run_if_enabled(const std::string& action) {
  ASSERT_TRUE(becomes_enabled(action)) << action;
  run_by_palette(action);
  // The name of the files of a sequence is a step of its own.
  if (action != "sequence.start") close_popups();
}

// The actions of panels close a panel that is open.
bool Actions::is_open_panel(const std::string& action) {
  return action == "view." + user_->report()["bottom_panel"].get<std::string>();
}

std::pair<int, int> Actions::in_image(double x, double y) {
  const json image = user_->report()["image"];
  return {static_cast<int>(image[0].get<double>() + x * image[2].get<double>()),
          static_cast<int>(image[1].get<double>() + y * image[3].get<double>())};
}

void Actions::click_image(double x) {
  const auto [pixel_x, pixel_y] = in_image(x, 0.5);
  user_->click_at(pixel_x, pixel_y);
}

void Actions::drag_in_image() {
  const auto [x, y] = in_image(0.3, 0.4);
  user_->drag_at(x, y, 120, 80);
}

void Actions::enter(const std::string& parameter, const std::string& value) {
  run_by_palette(parameter);
  user_->click(parameter);
  user_->press("ctrl+a");
  user_->type(value);
  user_->press("Return");
}

void Actions::save_as(const std::string& name) {
  user_->click("files.name");
  user_->press("ctrl+a");
  user_->type((folder_ / name).string());
  user_->press("Return");
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace etendue
