// A fixture for tests that use every action of the program in a real window. An action has to be enabled when it is
// chosen; where that needs other steps first, they are listed here.
#pragma once
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "window_test.h"

namespace etendue {

class Actions : public Window {
 public:
  // The actions of the program, from `etendue list widgets --json`.
  static const json& all();
  // Actions that these tests do not choose, because they have tests of their own.
  static const std::set<std::string>& left_out();

 protected:
  // What the user does before an action: another action; "image", a click on a surface; "shift+image", another one;
  // "region", a drag in the image; "parameter=value", a value that is typed; "item:NAME", a click; "key:KEYS";
  // "save:NAME", the name in a file dialog.
  using Steps = std::vector<std::string>;

  // A window in which no menu and no list is cut.
  void SetUp() override;

  static bool is_enabled(const json& report, const std::string& action);
  bool becomes_enabled(const std::string& action, double seconds = 20);
  void close_popups();  // closes whatever an action has opened
  void run_by_palette(const std::string& action);
  // Enables an action that is disabled.
  void prepare(const std::string& action);
  void perform(const Steps& steps);

 private:
  void perform_step(const std::string& step);
  void run_if_enabled(const std::string& action);
  bool is_open_panel(const std::string& action);
  std::pair<int, int> in_image(double x, double y);
  void click_image(double x);
  void drag_in_image();
  void enter(const std::string& parameter, const std::string& value);
  void save_as(const std::string& name);
};

std::string lower_case(std::string text);

}  // namespace etendue
