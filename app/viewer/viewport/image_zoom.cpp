#include "viewer/viewport/image_zoom.h"

#include <algorithm>

#include "render/document.h"
#include "render/display_frame.h"
#include "viewer/state/app_state.h"
#include "viewer/viewport/comparison.h"

namespace etendue::viewer {
namespace {

Vec2 middle_of(const Placement& region) { return region.corner + region.size * 0.5f; }

// Along each axis, the image fills the viewport, or is in its middle if it is smaller.
Vec2 limited_centre(Vec2 centre, Vec2 shown, Vec2 region) {
  for (int c = 0; c < 2; ++c) {
    const float half = std::min(0.5f, 0.5f * region[c] / std::max(shown[c], 1.0f));
    centre[c] = std::clamp(centre[c], half, 1 - half);
  }
  return centre;
}

// The zoom that shows the point `relative` of the image at a position of the window.
ImageZoom zoom_about(const AppState& state, float scale, Vec2 relative, Vec2 position) {
  const Placement& region = state.viewport.region;
  const Vec2 shown = Vec2(shown_image_size(state)) * scale;
  const Vec2 centre = relative + (middle_of(region) - position) / glm::max(shown, Vec2(1));
  return {.scale = scale, .centre = limited_centre(centre, shown, region.size)};
}

}  // namespace

Placement placement_of(const ImageZoom& zoom, const Placement& region, Vec2i image_size) {
  if (zoom.is_fitted()) return fit_inside(region, image_size);
  const Vec2 shown = glm::max(glm::round(Vec2(image_size) * zoom.scale), Vec2(1));
  const Vec2 centre = limited_centre(zoom.centre, shown, region.size);
  return {glm::floor(middle_of(region) - centre * shown), shown};
}

Vec2i shown_image_size(const AppState& state) {
  const Comparison& c = *state.viewport.comparison;
  if (!c.is_active() || state.shows_aov()) return {state.document().width, state.document().height};
  return {c.left().frame->width, c.left().frame->height};
}

ImageZoom scaled(const AppState& state, float factor, Vec2 position) {
  const Placement& image = state.viewport.image;
  const float scale = std::clamp(current_scale(state) * factor, kMinZoom, kMaxZoom);
  return zoom_about(state, scale, (position - image.corner) / image.size, position);
}

ImageZoom moved(const AppState& state, Vec2 movement) {
  const ImageZoom& zoom = state.viewport.zoom;
  if (zoom.is_fitted()) return zoom;
  const Vec2 middle = middle_of(state.viewport.region);
  return zoom_about(state, zoom.scale, zoom.centre, middle + movement);
}

float current_scale(const AppState& state) {
  return state.viewport.image.size.x / static_cast<float>(std::max(shown_image_size(state).x, 1));
}

void set_scale(AppState& state, float scale) {
  if (scale == 0) {
    state.viewport.zoom = {};
    return;
  }
  const Vec2 centre = state.viewport.zoom.centre;
  state.viewport.zoom = zoom_about(state, scale, centre, middle_of(state.viewport.region));
}

}  // namespace etendue::viewer
