#include "viewer/viewport/comparison_view.h"

#include <cmath>

#include "render/document.h"
#include "viewer/state/app_state.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/viewport/comparison.h"

namespace etendue::viewer {

float divider_x(const AppState& state) {
  const Placement visible = state.viewport.visible_image();
  return visible.corner.x + std::round(visible.size.x * state.viewport.comparison->divider);
}

ImageView& ComparisonView::view_of(const AppState& state, SlotIndex slot_index, Vec2i size, const Pixels& pixels) {
  if (pixels == state.viewport.frame->pixels) return live_;
  Slot& slot = slots_[slot_index];
  if (!slot.image) {
    auto image = std::make_unique<ImageView>(gl_);
    if (!image->start()) return live_;
    slot.image = std::move(image);
  }
  if (slot.pixels != pixels) slot.image->upload(size.x, size.y, *pixels);
  slot.pixels = pixels;
  return *slot.image;
}

ImageView& ComparisonView::view_of(const AppState& state, SlotIndex slot_index, const Side& side) {
  return view_of(state, slot_index, {side.frame->width, side.frame->height}, side.frame->pixels);
}

void ComparisonView::draw(const AppState& state, GLuint framebuffer, Vec2i framebuffer_size) {
  const Placement& place = state.viewport.image;
  const Placement visible = state.viewport.visible_image();
  const auto& display = state.document().display;
  const DisplaySettings settings{
      .exposure = display.exposure, .curve = display.curve, .false_color = state.viewport.false_color};
  const DisplaySettings unchanged;  // for false-colour images
  const Comparison& c = *state.viewport.comparison;
  if (state.shows_aov()) {
    const bool is_radiance = state.viewport.aov->image().is_radiance;
    return live_.draw(framebuffer, framebuffer_size, place, is_radiance ? settings : unchanged, visible);
  }
  if (c.reference_is_shown())
    return view_of(state, reference_slot, c.reference).draw(framebuffer, framebuffer_size, place, settings, visible);
  if (!c.is_active()) return live_.draw(framebuffer, framebuffer_size, place, settings, visible);
  if (const auto map = c.map()) {
    const Pixels pixels(map, &map->pixels);
    const Vec2i size{c.left().frame->width, c.left().frame->height};
    return view_of(state, map_slot, size, pixels).draw(framebuffer, framebuffer_size, place, unchanged, visible);
  }
  // The left image is shown until the first map is computed.
  ImageView& left = view_of(state, left_slot, c.left());
  if (c.mode != CompareMode::wipe) return left.draw(framebuffer, framebuffer_size, place, settings, visible);
  const float x = divider_x(state);
  const float end = visible.corner.x + visible.size.x;
  const Placement left_part{visible.corner, {x - visible.corner.x, visible.size.y}};
  const Placement right_part{{x, visible.corner.y}, {end - x, visible.size.y}};
  left.draw(framebuffer, framebuffer_size, place, settings, left_part);
  view_of(state, right_slot, c.right()).draw(framebuffer, framebuffer_size, place, settings, right_part);
}

}  // namespace etendue::viewer
