// What the window shows: framing, display and interface.
#include <algorithm>

#include "render/automatic_exposure.h"
#include "render/display_frame.h"
#include "render/document.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "viewer/actions/all_actions.h"
#include "viewer/actions/conditions.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/viewport/viewport.h"

namespace etendue::viewer {
namespace {

constexpr double kExposureStep = 0.5;  // stops

void change_exposure(AppState& state, double stops) {
  const auto parameter = document_parameter(state.document(), "camera.exposure");
  const double exposure = std::get<double>(parameter->info.default_value) + stops;
  state.edit(*parameter, std::clamp(exposure, parameter->info.min, parameter->info.max), "keys.exposure");
}

void set_automatic_exposure(AppState& state) {
  const auto scene = state.session->scene();
  const auto& frame = state.viewport.frame;
  if (!scene || !frame || frame->version != state.editor->version()) return;
  const auto luminances = render::surface_luminances(state.document(), *scene, *frame->pixels);
  const auto exposure = render::automatic_exposure(luminances);
  if (!exposure) return state.notices.add_message("The visible surfaces are black, so no exposure shows them.");
  state.edit(*document_parameter(state.document(), "camera.exposure"), static_cast<double>(*exposure));
}

// After the last AOV follows the image itself.
void show_next_aov(AppState& state) {
  const auto scene = state.session->scene();
  const auto names = aov_layer_names(scene.get());
  std::string& shown = state.viewport.aov_name;
  if (shown.empty()) {
    shown = names.front();
    return;
  }
  const auto current = std::ranges::find(names, shown);
  const bool is_last = current == names.end() || current + 1 == names.end();
  shown = is_last ? "" : *(current + 1);
}

void toggle_denoised(AppState& state) {
  std::string& shown = state.viewport.aov_name;
  shown = shown == kDenoisedLayer ? "" : kDenoisedLayer;
}

void fit_image_to_viewport(AppState& state) {
  render::Document changed = state.document();
  fit_image(changed, state.viewport.region.size);
  state.edit(std::move(changed), "Image size");
}

void toggle_theme(AppState& state) {
  state.settings.dark = !state.settings.dark;
  state.interface.style_is_outdated = true;
  state.store_settings();
}

void add_framing_actions(ActionList& actions) {
  actions.add({.name = "view.frame-all",
               .menu = "View",
               .label = "Frame all",
               .tooltip = "Moves the camera so that it shows the whole scene",
               .shortcut = "home",
               .run = frame_scene,
               .enabled = has_document,
               .section = "framing"});
  actions.add({.name = "view.frame-selection",
               .menu = "View",
               .label = "Frame selection",
               .tooltip = "Moves the camera so that the selected object fills the image",
               .shortcut = "f",
               .run = frame_selection,
               .enabled = has_document,
               .section = "framing"});
  actions.add({.name = "view.reset-camera",
               .menu = "View",
               .label = "Reset camera",
               .tooltip = "Uses the camera of the file again, or a view of the scene if that camera sees nothing",
               .shortcut = "shift+home",
               .run = reset_view,
               .enabled = has_document,
               .section = "framing"});
  actions.add({.name = "view.fit",
               .menu = "View",
               .label = "Fit image to viewport",
               .tooltip = "Sets the resolution of the image to that of the viewport. Restarts the rendering",
               .run = fit_image_to_viewport,
               .enabled = has_document,
               .section = "framing"});
}

void add_display_actions(ActionList& actions) {
  actions.add({.name = "display.darker",
               .menu = "View",
               .label = "Exposure down",
               .tooltip = "Decreases the exposure by half a stop",
               .shortcut = "[",
               .run = [](AppState& state) { change_exposure(state, -kExposureStep); },
               .enabled = has_document,
               .section = "display",
               .submenu = "Exposure"});
  actions.add({.name = "display.brighter",
               .menu = "View",
               .label = "Exposure up",
               .tooltip = "Increases the exposure by half a stop",
               .shortcut = "]",
               .run = [](AppState& state) { change_exposure(state, kExposureStep); },
               .enabled = has_document,
               .section = "display",
               .submenu = "Exposure"});
  actions.add({.name = "display.auto-exposure",
               .menu = "View",
               .label = "Automatic exposure",
               .tooltip = "Sets the exposure so that the bright surfaces in the image are just below white",
               .shortcut = "a",
               .run = set_automatic_exposure,
               .enabled = has_document,
               .section = "display",
               .submenu = "Exposure"});
  actions.add({.name = "display.next-aov",
               .menu = "View",
               .label = "Next AOV",
               .tooltip = "Shows the next AOV: albedo, normals, depth, position, ids, parts of the light, importance, "
                          "error, denoised; then the image again",
               .shortcut = "v",
               .run = show_next_aov,
               .enabled = has_document,
               .section = "display"});
  actions.add(
      {.name = "display.toggle-denoised",
       .menu = "View",
       .label = "Denoised",
       .tooltip = "Shows a denoised image, which is biased. Errors, checkpoints and exports keep the image itself",
       .shortcut = "shift+v",
       .run = toggle_denoised,
       .enabled = has_document,
       .checked = [](const AppState& state) { return state.viewport.aov_name == kDenoisedLayer; },
       .section = "display"});
  actions.add({.name = "display.toggle-false-color",
               .menu = "View",
               .label = "False colour",
               .tooltip = "Shows the luminance on a logarithmic scale",
               .shortcut = "l",
               .run = [](AppState& state) { state.viewport.false_color = !state.viewport.false_color; },
               .checked = [](const AppState& state) { return state.viewport.false_color; },
               .section = "display"});
  actions.add({.name = "view.icons",
               .menu = "View",
               .label = "Show lights and cameras",
               .tooltip = "Draws an icon at each light and camera. A click on it selects the object",
               .run = [](AppState& state) { state.viewport.show_icons = !state.viewport.show_icons; },
               .enabled = has_document,
               .checked = [](const AppState& state) { return state.viewport.show_icons; },
               .section = "overlays",
               .submenu = "Overlays"});
  actions.add({.name = "view.reliability-map",
               .menu = "View",
               .label = "Show unreliable regions",
               .tooltip = "Marks tiles with heavy-tailed noise, where the error estimate cannot be trusted",
               .run = [](AppState& state) { state.viewport.show_reliability = !state.viewport.show_reliability; },
               .enabled = has_document,
               .checked = [](const AppState& state) { return state.viewport.show_reliability; },
               .section = "overlays",
               .submenu = "Overlays"});
  actions.add(
      {.name = "view.points",
       .menu = "View",
       .label = "Show photons and virtual lights",
       .tooltip = "Draws the photons or virtual point lights that the integrator stores, coloured by their power",
       .run = [](AppState& state) { state.viewport.show_stored_points = !state.viewport.show_stored_points; },
       .enabled = has_document,
       .checked = [](const AppState& state) { return state.viewport.show_stored_points; },
       .section = "overlays",
       .submenu = "Overlays"});
}

void add_safe_frames(ActionList& actions) {
  actions.add({.name = "view.safe-frames",
               .menu = "View",
               .label = "Safe frames",
               .tooltip = "Draws the action-safe area (93 % of the image), the title-safe area (90 %) and the centre",
               .run = [](AppState& state) { state.viewport.show_safe_frames = !state.viewport.show_safe_frames; },
               .enabled = has_document,
               .checked = [](const AppState& state) { return state.viewport.show_safe_frames; },
               .section = "overlays",
               .submenu = "Overlays"});
}

void add_animation_actions(ActionList& actions) {
  actions.add({.name = "animation.play",
               .menu = "View",
               .label = "Play",
               .tooltip = "Plays the animations of the file, or stops them",
               .shortcut = "p",
               .run = toggle_playback,
               .enabled = is_animated,
               .checked = [](const AppState& state) { return state.viewport.playback.is_playing; },
               .section = "animation",
               .submenu = "Animation"});
  actions.add({.name = "animation.previous-frame",
               .menu = "View",
               .label = "Previous frame",
               .tooltip = "Moves the time of the animations back by one frame of the timeline",
               .shortcut = ",",
               .run = [](AppState& state) { step_frame(state, -1); },
               .enabled = is_animated,
               .section = "animation",
               .submenu = "Animation"});
  actions.add({.name = "animation.next-frame",
               .menu = "View",
               .label = "Next frame",
               .tooltip = "Moves the time of the animations on by one frame of the timeline",
               .shortcut = ".",
               .run = [](AppState& state) { step_frame(state, 1); },
               .enabled = is_animated,
               .section = "animation",
               .submenu = "Animation"});
  actions.add({.name = "animation.range-start",
               .menu = "View",
               .label = "Start range here",
               .tooltip = "Playback, frame steps and sequences start at the present frame",
               .run = start_range_here,
               .enabled = is_animated,
               .section = "animation",
               .submenu = "Animation"});
  actions.add({.name = "animation.range-end",
               .menu = "View",
               .label = "End range here",
               .tooltip = "Playback, frame steps and sequences end at the present frame",
               .run = end_range_here,
               .enabled = is_animated,
               .section = "animation",
               .submenu = "Animation"});
  actions.add(
      {.name = "animation.clear-range",
       .menu = "View",
       .label = "Clear range",
       .tooltip = "Plays the whole clip again",
       .run = [](AppState& state) { state.viewport.playback.first = state.viewport.playback.last = {}; },
       .enabled = [](const AppState& state) { return state.viewport.playback.first || state.viewport.playback.last; },
       .section = "animation",
       .submenu = "Animation"});
}

void add_interface_actions(ActionList& actions) {
  actions.add({.name = "view.interface",
               .menu = "View",
               .label = "Show interface",
               .tooltip = "Shows or hides everything except the image",
               .shortcut = "h",
               .run = [](AppState& state) { state.interface.visible = !state.interface.visible; },
               .checked = [](const AppState& state) { return state.interface.visible; },
               .section = "interface"});
  actions.add({.name = "view.dark",
               .menu = "View",
               .label = "Dark theme",
               .tooltip = "Switches between the dark and the light theme",
               .run = toggle_theme,
               .checked = [](const AppState& state) { return state.settings.dark; },
               .section = "interface"});
  actions.add({.name = "app.palette",
               .menu = "Help",
               .label = "Find a command...",
               .tooltip = "Searches all commands by name",
               .shortcut = "ctrl+k",
               .run = [](AppState& state) { state.interface.palette_open = true; }});
  actions.add({.name = "app.welcome",
               .menu = "Help",
               .label = "Welcome page",
               .tooltip = "Shows the built-in scenes and recent files",
               .run = [](AppState& state) { state.interface.welcome_open = true; }});
  actions.add({.name = "app.help",
               .menu = "Help",
               .label = "Keyboard and mouse shortcuts",
               .tooltip = "Lists all keyboard and mouse shortcuts",
               .shortcut = "f1 ?",
               .run = [](AppState& state) { state.interface.help_open = !state.interface.help_open; },
               .checked = [](const AppState& state) { return state.interface.help_open; }});
}

}  // namespace

void add_view_actions(ActionList& actions) {
  add_framing_actions(actions);
  add_display_actions(actions);
  add_safe_frames(actions);
  add_animation_actions(actions);
  add_interface_actions(actions);
}

}  // namespace etendue::viewer
