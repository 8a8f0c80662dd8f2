// The viewer: a scene on screen while it renders, with everything that can be set beside it.
#pragma once
#include <string>

namespace etendue::viewer {

struct ViewOptions {
  std::string scene;       // a file, the name of a built-in scene, or a snapshot; empty opens the Cornell box
  bool offscreen = false;  // the same program without a display
  std::string script;      // a JSON file of user actions; the viewer ends with it
  int width = 1280, height = 720;
  int threads = 0;    // 0: one per hardware thread
  bool safe = false;  // neither reads nor writes remembered settings
};

// Runs until the window is closed or the script ends; gives the exit code. Errors go to standard error.
int run_viewer(const ViewOptions& options);

// Every name that a script can use, with what it is: a JSON array like those of the other lists.
std::string widgets_json();

}  // namespace etendue::viewer
