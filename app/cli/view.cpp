// etendue view: the workbench in a window, or the same without a display and driven by a script.
#include <CLI/CLI.hpp>
#include <memory>

#include "command.h"
#include "scene/builtin/builtin.h"
#include "size.h"
#include "viewer/viewer.h"

namespace etendue::cli {

Command add_view(CLI::App& app) {
  struct Options {
    viewer::ViewOptions view;
    std::string size;
  };
  auto o = std::make_shared<Options>();
  app.add_option("scene", o->view.scene,
                 "A .gltf or .glb file, a snapshot, or one of " + scene::builtin_names() + "; without it, cornell");
  app.add_flag("--offscreen", o->view.offscreen, "Run without a display");
  app.add_option("--script", o->view.script, "A JSON file of user actions; the viewer ends with it");
  app.add_option("--size", o->size, "Width and height of the window in pixels, like 1920x1080 (1280x720)");
  app.add_option("--threads", o->view.threads, "How many threads render; 0 takes one for each of the processor's")
      ->check(CLI::Range(0, 1024));
  app.add_flag("--safe", o->view.safe, "Neither read nor write what the viewer remembers");
  return [o] {
    if (!o->size.empty()) {
      const auto size = parse_size(o->size);
      if (!size) return fail(size.error());
      o->view.width = size->x, o->view.height = size->y;
    }
    return viewer::run_viewer(o->view);
  };
}

}  // namespace etendue::cli
