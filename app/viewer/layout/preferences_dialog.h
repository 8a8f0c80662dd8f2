// The Preferences dialog: interface, rendering, files and keyboard shortcuts.
#pragma once
#include <string>

#include "base/parameter.h"

namespace etendue::viewer {

struct Action;
struct AppState;

class PreferencesDialog {
 public:
  // Shows the dialog while InterfaceState::preferences_open is set.
  void draw(AppState& state);

 private:
  void draw_keyboard(AppState& state);
  void draw_shortcut(AppState& state, const Action& action);
  // Takes the keys that are pressed as the new shortcut of the action that waits for one.
  void capture_shortcut(AppState& state);

  std::string filter_;     // of the list of shortcuts
  std::string capturing_;  // name of the action whose shortcut is entered; empty: none
};

// Changes a preference, which is then kept.
void set_preference(AppState& state, const std::string& name, const Value& value);
// Opens the dialog and marks the widget of a preference.
void show_preference(AppState& state, const std::string& name);

}  // namespace etendue::viewer
