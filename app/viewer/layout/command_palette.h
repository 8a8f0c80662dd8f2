// The command palette: finds an action by a part of its name, label or tooltip.
#pragma once
#include <string>

namespace etendue::viewer {

struct AppState;

class CommandPalette {
 public:
  void draw(AppState& state);

 private:
  std::string text_;
  size_t selected_ = 0;  // index into the matching actions
};

}  // namespace etendue::viewer
