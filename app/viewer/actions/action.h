// Actions: everything that a user can do by a menu entry, a shortcut, a button, the command palette or a script. All of
// these read the list of actions, so each action is described once.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/platform/input.h"

namespace etendue::viewer {

struct AppState;

struct Action {
  std::string name;    // used by scripts: "snapshot.save"
  std::string menu{};  // "File", "Edit", ...; empty if the action is in no menu
  std::string label;
  std::string tooltip;
  std::string shortcut{};  // chords as parse_chord reads them, separated by spaces
  std::function<void(AppState&)> run;
  std::function<bool(const AppState&)> enabled{};  // null: always enabled
  std::function<bool(const AppState&)> checked{};  // null: not a switch
  std::string group{};                             // heading above the action in its menu
  std::string group_tooltip{};
  std::string section{};           // entries of different sections are separated by a line
  std::string submenu{};           // of the menu that contains the action
  std::string default_shortcut{};  // set by ActionList::add

  std::vector<Chord> chords() const;
  bool is_enabled(const AppState& state) const { return !enabled || enabled(state); }
  bool is_checked(const AppState& state) const { return checked && checked(state); }
};

class ActionList {
 public:
  void add(Action action);
  const std::vector<Action>& all() const { return actions_; }
  // Null if there is no action of this name.
  const Action* find(std::string_view name) const;
  // Replaces the shortcut of an action. Unknown names and unreadable shortcuts are ignored.
  void set_shortcut(std::string_view name, const std::string& shortcut);
  // The action, other than `name`, that already has this chord; null if there is none.
  const Action* find_conflict(std::string_view name, const Chord& chord) const;
  // Runs the enabled actions whose shortcuts were pressed in this frame.
  void run_pressed(AppState& state, const Input& input) const;

 private:
  std::vector<Action> actions_;
};

}  // namespace etendue::viewer
