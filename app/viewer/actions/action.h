// Everything that can be done, once: menus, shortcuts, the palette, the help sheet and scripts read this list.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/platform/input.h"

namespace etendue::viewer {

struct Workbench;

struct Action {
  std::string name;  // "snapshot.save": what scripts say
  std::string menu;  // "File", "Edit", ...; empty for what has only a shortcut
  std::string label, doc;
  std::string shortcut;  // as parse_chord reads it, or nothing
  std::function<void()> run;
  std::function<bool()> enabled;               // missing: always
  std::function<bool()> checked;               // missing: it is no switch
  std::string heading = {}, heading_doc = {};  // of its part of the menu; empty where the menu has no parts

  std::vector<Chord> chords() const;  // shortcuts are separated by spaces
  bool is_enabled() const { return !enabled || enabled(); }
};

class Actions {
 public:
  void add(Action action) { list_.push_back(std::move(action)); }
  const std::vector<Action>& all() const { return list_; }
  const Action* find(std::string_view name) const;
  // Runs the actions whose keys were pressed in this frame.
  void run_pressed(const Input& input) const;

 private:
  std::vector<Action> list_;
};

// `workbench` is used when an action runs, not before.
void add_actions(Actions& actions, Workbench* workbench);

}  // namespace etendue::viewer
