// The page that the viewer shows when it is started without a scene: built-in scenes as images, and recent files.
#pragma once
#include <string>
#include <vector>

#include "viewer/widgets/thumbnails.h"

namespace etendue::viewer {

struct AppState;

class WelcomeDialog {
 public:
  // Shows the page while interface.welcome_open is set.
  void draw(AppState& state);

 private:
  // Both return whether a scene was opened.
  bool draw_builtin_scenes(AppState& state);
  bool draw_recent_files(AppState& state);
  void find_recent_files(const AppState& state);

  bool is_open_ = false;
  std::vector<std::string> recent_;  // that exist; looked up when the page opens
  Thumbnails textures_;
};

}  // namespace etendue::viewer
