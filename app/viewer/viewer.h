// The viewer: shows a scene while it is rendered, with panels for all parameters.
#pragma once
#include <string>

namespace etendue::render {
class SharedSampling;
}

namespace etendue::viewer {

struct ViewOptions {
  std::string scene;       // a file, the name of a built-in scene, or a snapshot; empty: the Cornell box
  bool offscreen = false;  // runs without a display
  std::string script;      // a JSON file of user actions; the viewer ends when the script ends
  int width = 1280;        // of the window, pixels
  int height = 720;
  int threads = 0;       // 0: one per hardware thread
  bool safe = false;     // settings and unsaved edits of earlier runs are neither read nor written
  std::string settings;  // folder for them; empty: the folders of the user, except for scripts and off-screen runs
  render::SharedSampling* sharing = nullptr;  // other processes that render samples; null: none
};

// Runs until the window is closed or the script ends. Returns the exit code. Errors are written to standard error.
int run_viewer(const ViewOptions& options);

// All names that scripts can use, with descriptions: a JSON array like those of the other lists.
std::string widgets_json();

}  // namespace etendue::viewer
