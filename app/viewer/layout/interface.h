// The arrangement of the window: menu bar, viewport, right column, bottom panel and status bar.
#pragma once
#include "viewer/layout/command_palette.h"
#include "viewer/layout/file_dialog.h"
#include "viewer/layout/preferences_dialog.h"
#include "viewer/layout/welcome_dialog.h"
#include "viewer/viewport/viewport.h"

namespace etendue::viewer {

struct AppState;

class Interface {
 public:
  // Handles shortcuts and draws one frame; `seconds` is the time since the last frame.
  void draw(AppState& state, float seconds);

 private:
  ViewportController viewport_;
  CommandPalette palette_;
  PreferencesDialog preferences_;
  FileDialog file_dialog_;
  WelcomeDialog welcome_;
};

}  // namespace etendue::viewer
