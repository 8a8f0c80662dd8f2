// Pan and zoom of the image.
#include "render/document.h"
#include "viewer/actions/all_actions.h"
#include "viewer/actions/conditions.h"
#include "viewer/viewport/image_zoom.h"

namespace etendue::viewer {
namespace {

constexpr float kZoomStep = 1.4142135f;

void scale_about_middle(AppState& state, float factor) {
  const Placement& region = state.viewport.region;
  state.viewport.zoom = scaled(state, factor, region.corner + region.size * 0.5f);
}

void add_zoom(ActionList& actions, const char* name, const char* label, const char* tooltip, const char* shortcut,
              std::function<void(AppState&)> run, std::function<bool(const AppState&)> checked = {}) {
  actions.add({.name = name,
               .menu = "View",
               .label = label,
               .tooltip = tooltip,
               .shortcut = shortcut,
               .run = std::move(run),
               .enabled = has_document,
               .checked = std::move(checked),
               .section = "framing",
               .submenu = "Zoom"});
}

bool has_scale(const AppState& state, float scale) {
  return state.has_document() && state.viewport.zoom.scale == scale;
}

}  // namespace

void add_zoom_actions(ActionList& actions) {
  add_zoom(
      actions, "zoom.fit", "Fit", "Shows the whole image as large as the viewport allows", "ctrl+0",
      [](AppState& state) { set_scale(state, 0); }, [](const AppState& state) { return has_scale(state, 0); });
  add_zoom(
      actions, "zoom.100", "100 %", "Shows each pixel of the image as one pixel of the window", "ctrl+1",
      [](AppState& state) { set_scale(state, 1); }, [](const AppState& state) { return has_scale(state, 1); });
  add_zoom(
      actions, "zoom.200", "200 %", "Shows each pixel of the image as 2 x 2 pixels of the window", "ctrl+2",
      [](AppState& state) { set_scale(state, 2); }, [](const AppState& state) { return has_scale(state, 2); });
  add_zoom(actions, "zoom.in", "Zoom in", "Enlarges the image. Ctrl and the wheel do this at the pointer",
           "ctrl+=", [](AppState& state) { scale_about_middle(state, kZoomStep); });
  add_zoom(actions, "zoom.out", "Zoom out", "Reduces the image", "ctrl+-",
           [](AppState& state) { scale_about_middle(state, 1 / kZoomStep); });
}

}  // namespace etendue::viewer
