// Values of single pixels.
#include "render/document.h"
#include "viewer/actions/all_actions.h"
#include "viewer/actions/conditions.h"
#include "viewer/viewport/placement.h"

namespace etendue::viewer {
namespace {

constexpr const char* kPinPixel = "view.pin-pixel";

bool pin_pixel_at(AppState& state, Vec2 position) {
  const auto& d = state.document();
  state.viewport.pinned_pixel = pixel_at(state.viewport.image, {d.width, d.height}, position);
  state.viewport.show_pixel_values = true;
  return true;
}

}  // namespace

void add_inspection_actions(ActionList& actions) {
  actions.add({.name = "view.pixel-values",
               .menu = "View",
               .label = "Pixel values",
               .tooltip = "Shows radiance, displayed value, samples and standard error of the pixel under the pointer. The window "
                          "can be dragged",
               .shortcut = "i",
               .run = [](AppState& state) { state.viewport.show_pixel_values = !state.viewport.show_pixel_values; },
               .enabled = has_document,
               .checked = [](const AppState& state) { return state.viewport.show_pixel_values; },
               .section = "overlays"});
  actions.add({.name = kPinPixel,
               .menu = "View",
               .label = "Pin a pixel",
               .tooltip = "Keeps the values of the pixel where you click next on screen, beside those at the pointer",
               .run = [](AppState& state) { state.toggle_tool({.name = kPinPixel, .use = pin_pixel_at}); },
               .enabled = has_document,
               .checked = [](const AppState& state) { return state.is_active_tool(kPinPixel); },
               .section = "overlays"});
  actions.add({.name = "view.unpin-pixel",
               .menu = "View",
               .label = "Unpin the pixel",
               .tooltip = "Shows only the values of the pixel under the pointer",
               .run = [](AppState& state) { state.viewport.pinned_pixel.reset(); },
               .enabled = [](const AppState& state) { return state.viewport.pinned_pixel.has_value(); },
               .section = "overlays"});
}

}  // namespace etendue::viewer
