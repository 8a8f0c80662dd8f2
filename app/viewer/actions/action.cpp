#include "viewer/actions/action.h"

#include <sstream>
#include <utility>

namespace etendue::viewer {

std::vector<Chord> Action::chords() const {
  std::vector<Chord> chords;
  std::istringstream words(shortcut);
  for (std::string word; words >> word;)
    if (const auto chord = parse_chord(word)) chords.push_back(*chord);
  return chords;
}

void ActionList::add(Action action) {
  action.default_shortcut = action.shortcut;
  actions_.push_back(std::move(action));
}

void ActionList::set_shortcut(std::string_view name, const std::string& shortcut) {
  for (auto& action : actions_) {
    if (action.name != name) continue;
    const std::string previous = std::exchange(action.shortcut, shortcut);
    if (!shortcut.empty() && action.chords().empty()) action.shortcut = previous;
  }
}

const Action* ActionList::find_conflict(std::string_view name, const Chord& chord) const {
  for (const auto& action : actions_)
    for (const Chord& used : action.chords())
      if (action.name != name && used == chord) return &action;
  return nullptr;
}

const Action* ActionList::find(std::string_view name) const {
  for (const auto& action : actions_)
    if (action.name == name) return &action;
  return nullptr;
}

void ActionList::run_pressed(AppState& state, const Input& input) const {
  if (input.keys_pressed.none()) return;
  for (const auto& action : actions_)
    for (const Chord& chord : action.chords())
      if (chord.pressed(input) && action.is_enabled(state)) action.run(state);
}

}  // namespace etendue::viewer
