#include "viewer/actions/action.h"

#include <sstream>

namespace etendue::viewer {

std::vector<Chord> Action::chords() const {
  std::vector<Chord> chords;
  std::istringstream words(shortcut);
  for (std::string word; words >> word;)
    if (const auto chord = parse_chord(word)) chords.push_back(*chord);
  return chords;
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
