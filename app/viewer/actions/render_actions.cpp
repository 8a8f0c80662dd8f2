// Control of the rendering.
#include "render/session.h"
#include "viewer/actions/all_actions.h"
#include "viewer/actions/conditions.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/exclusive_task.h"

namespace etendue::viewer {

void add_render_actions(ActionList& actions) {
  actions.add(
      {.name = "render.pause",
       .menu = "Render",
       .label = "Pause",
       .tooltip = "Pauses the rendering. The image stays as it is",
       .shortcut = "space",
       .run = [](AppState& state) { state.session->pause(!state.session->paused()); },
       .enabled = [](const AppState& state) { return state.has_document() && !state.tasks.exclusive->running(); },
       .checked = [](const AppState& state) { return state.session->paused(); }});
  actions.add({.name = "render.restart",
               .menu = "Render",
               .label = "Restart",
               .tooltip = "Discards all samples and starts again",
               .shortcut = "r",
               .run = [](AppState& state) { state.editor->restart(); },
               .enabled = has_document});
  actions.add({.name = "view.region",
               .menu = "View",
               .label = "Region of interest",
               .tooltip = "A rectangle of the image, which you drag with the left button, receives all samples. It has "
                          "an error of its own, to which the limits refer",
               .shortcut = "b",
               .run = toggle_focus_region,
               .enabled = has_document,
               .checked =
                   [](const AppState& state) {
                     return state.viewport.focus.exists() || state.viewport.focus.is_selecting();
                   },
               .section = "framing"});
  actions.add({.name = "view.clear-region",
               .menu = "View",
               .label = "Clear region",
               .tooltip = "Samples the whole image again. Pixels with fewer samples come first",
               .run = [](AppState& state) { state.viewport.focus.clear(); },
               .enabled = [](const AppState& state) { return state.viewport.focus.exists(); },
               .section = "framing"});
}

}  // namespace etendue::viewer
