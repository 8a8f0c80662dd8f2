// The command palette: finds an action, a parameter or a value of a parameter by a part of its name, label or tooltip.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace etendue::viewer {

struct AppState;

// A line of the list.
struct PaletteEntry {
  std::string name;  // of the item, for scripts
  std::string label;
  std::string place;   // menu or section
  std::string keys{};  // shortcut or current value
  std::string tooltip;
  std::function<void(AppState&)> run;
};

class CommandPalette {
 public:
  void draw(AppState& state);

 private:
  void open(AppState& state);
  // The entries that contain all words of the text; those whose labels do come first.
  std::vector<const PaletteEntry*> matching() const;

  std::string text_;
  size_t selected_ = 0;                // index into the matching entries
  std::vector<PaletteEntry> entries_;  // made when the palette opens
  std::vector<std::string> labels_;    // of each entry, in lower case
  std::vector<std::string> searched_;  // label, name, place and tooltip of each entry, in lower case
};

}  // namespace etendue::viewer
