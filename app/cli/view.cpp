// etendue view: the viewer, in a window, or without a display and controlled by a script.
#include <memory>

#include "cluster/mpi_job.h"
#include "command.h"
#include "scene/builtin/builtin.h"
#include "scene_options.h"
#include "view_ranks.h"
#include "viewer/viewer.h"

namespace etendue::cli {

Command view_command() {
  struct ViewArguments {
    viewer::ViewOptions view;
    std::string size;
  };
  const auto a = std::make_shared<ViewArguments>();
  return {.name = "view",
          .summary = "Open the viewer; the default without a subcommand",
          .options =
              {{.names = "scene",
                .target = &a->view.scene,
                .doc = "A glTF file (.gltf or .glb), a session (.etendue), a snapshot (.exr), or a built-in scene: " +
                       scene::builtin_names() + "; default: cornell"},
               {.names = "--offscreen", .target = &a->view.offscreen, .doc = "Run without a display"},
               {.names = "--script",
                .target = &a->view.script,
                .doc = "JSON file of user actions; the viewer closes after the last one"},
               {.names = "--size", .target = &a->size, .doc = "Size of the window in pixels, WIDTHxHEIGHT (1280x720)"},
               threads_option(a->view.threads),
               {.names = "--safe",
                .target = &a->view.safe,
                .doc = "Use default settings; neither read nor write the remembered ones"},
               {.names = "--settings",
                .target = &a->view.settings,
                .doc = "Folder for settings and unsaved edits; default: the folders of the user, and none with "
                       "--script or --offscreen"}},
          .run = [a] {
            if (!a->size.empty()) {
              const auto size = parse_size(a->size);
              if (!size) return fail(size.error());
              a->view.width = size->x;
              a->view.height = size->y;
            }
            return cluster::is_mpi_job() ? view_on_ranks(a->view) : viewer::run_viewer(a->view);
          },
          .supports_ranks = true};
}

}  // namespace etendue::cli
