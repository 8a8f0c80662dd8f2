// Comparison of images in the viewport.
#include "image/format.h"
#include "viewer/actions/all_actions.h"
#include "viewer/actions/conditions.h"
#include "viewer/viewport/comparison.h"

namespace etendue::viewer {
namespace {

constexpr const char* kGroup = "Images";
constexpr float kDividerStep = 0.01f;  // of the width of the image

bool has_image(const AppState& state) { return state.viewport.comparison->live.frame != nullptr; }

bool has_divider(const AppState& state) {
  const Comparison& c = *state.viewport.comparison;
  return c.mode == CompareMode::wipe && c.is_active();
}

void pin_image(AppState& state) {
  Comparison& c = *state.viewport.comparison;
  c.pin();
  state.notices.add_message("Pinned as B: " + c.b.label + ". Edits now affect image A.");
}

// Without an image B, the current image is pinned as B.
void toggle_mode(AppState& state, CompareMode mode) {
  Comparison& c = *state.viewport.comparison;
  c.mode = c.mode == mode ? CompareMode::off : mode;
  if (c.mode != CompareMode::off && !c.b.frame) pin_image(state);
}

void request_image(AppState& state, Comparison::Target target) {
  const bool is_b = target == Comparison::Target::b;
  state.files.request = FileRequest{
      .title = std::string(is_b ? "Load image B" : "Load the reference image") + " (.exr, .hdr, .png, .tif, ...)",
      .extensions = image::readable_extensions(),
      .accept = [&state, target](const std::string& file) { state.viewport.comparison->load(file, target); }};
}

Action mode_action(const char* name, const char* label, const char* tooltip, const char* shortcut, CompareMode mode) {
  return {.name = name,
          .menu = "Compare",
          .label = label,
          .tooltip = tooltip,
          .shortcut = shortcut,
          .run = [mode](AppState& state) { toggle_mode(state, mode); },
          .enabled = has_image,
          .checked = [mode](const AppState& state) { return state.viewport.comparison->mode == mode; },
          .group = kGroup};
}

Action divider_action(const char* name, const char* label, const char* tooltip, const char* shortcut, float step) {
  return {.name = name,
          .menu = "Compare",
          .label = label,
          .tooltip = tooltip,
          .shortcut = shortcut,
          .run = [step](AppState& state) { state.viewport.comparison->move_divider(step); },
          .enabled = has_divider,
          .group = kGroup};
}

void add_mode_actions(ActionList& actions) {
  actions.add(mode_action("compare.split", "Split: A | B",
                          "Shows A and B on both sides of a divider. Without an image B, pins the current image as B",
                          "c", CompareMode::wipe));
  actions.add(mode_action("compare.difference", "Difference: A \u2212 B",
                          "Shows the signed difference of luminance: red where A is brighter, blue where B is", "",
                          CompareMode::difference));
  actions.add(mode_action("compare.flip", "FLIP: A and B",
                          "Shows the perceived difference of the displayed images by the FLIP metric, 0 to 1", "",
                          CompareMode::flip));
  actions.add({.name = "compare.swap",
               .menu = "Compare",
               .label = "Swap A and B",
               .tooltip = "Exchanges the sides of A and B",
               .shortcut = "x",
               .run =
                   [](AppState& state) {
                     Comparison& c = *state.viewport.comparison;
                     c.swapped = !c.swapped;
                   },
               .enabled = [](const AppState& state) { return state.viewport.comparison->is_active(); },
               .checked = [](const AppState& state) { return state.viewport.comparison->swapped; },
               .group = kGroup});
}

void add_image_actions(ActionList& actions) {
  actions.add({.name = "compare.pin",
               .menu = "Compare",
               .label = "Pin image as B",
               .tooltip = "Keeps the current image as B. Edits then affect image A",
               .run =
                   [](AppState& state) {
                     Comparison& c = *state.viewport.comparison;
                     if (c.mode == CompareMode::off) c.mode = CompareMode::wipe;
                     pin_image(state);
                   },
               .enabled = has_image,
               .group = kGroup});
  actions.add({.name = "compare.live-a",
               .menu = "Compare",
               .label = "Live image as A",
               .tooltip = "Compares the image that is being rendered with B again, instead of a stored image",
               .run = [](AppState& state) { state.viewport.comparison->a = {}; },
               .enabled =
                   [](const AppState& state) {
                     const Side& a = state.viewport.comparison->a;
                     return a.frame != nullptr || !a.unavailable.empty();
                   },
               .group = kGroup});
  actions.add({.name = "compare.load-b",
               .menu = "Compare",
               .label = "Load image as B...",
               .tooltip = "Loads an image of the same size (.exr, .hdr, .png, .tif, ...) as B",
               .run = [](AppState& state) { request_image(state, Comparison::Target::b); },
               .enabled = has_image,
               .group = kGroup});
  actions.add({.name = "compare.load-reference",
               .menu = "Compare",
               .label = "Load reference...",
               .tooltip = "Loads a reference image, which is shown while Shift is held",
               .run = [](AppState& state) { request_image(state, Comparison::Target::reference); },
               .enabled = has_image,
               .group = kGroup});
  actions.add({.name = "compare.reference",
               .menu = "Compare",
               .label = "Show reference",
               .tooltip = "Shows the reference image. Holding Shift does the same",
               .run =
                   [](AppState& state) {
                     Comparison& c = *state.viewport.comparison;
                     c.shows_reference = !c.shows_reference;
                   },
               .enabled = [](const AppState& state) { return state.viewport.comparison->reference.frame != nullptr; },
               .checked = [](const AppState& state) { return state.viewport.comparison->shows_reference; },
               .group = kGroup});
}

}  // namespace

void add_comparison_actions(ActionList& actions) {
  add_mode_actions(actions);
  add_image_actions(actions);
  actions.add(divider_action("compare.divider-left", "Move divider left", "Moves the divider by 1 % of the image width",
                             "alt+left", -kDividerStep));
  actions.add(divider_action("compare.divider-right", "Move divider right",
                             "Moves the divider by 1 % of the image width", "alt+right", kDividerStep));
}

}  // namespace etendue::viewer
