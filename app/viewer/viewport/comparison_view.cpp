#include "viewer/viewport/comparison_view.h"

#include <cmath>

#include "render/document.h"
#include "viewer/state/app_state.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/viewport/comparison.h"

namespace etendue::viewer {

float divider_x(const AppState& state) {
  const Placement& image = state.viewport.image;
  return image.corner.x + std::round(image.size.x * state.viewport.comparison->divider);
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
  const auto& display = state.document().display;
  const DisplaySettings settings{
      .exposure = display.exposure, .curve = display.curve, .false_color = state.viewport.false_color};
  const DisplaySettings unchanged;  // for false-colour images
  const Comparison& c = *state.viewport.comparison;
  if (state.shows_aov()) {
    const bool is_radiance = state.viewport.aov->image().is_radiance;
    return live_.draw(framebuffer, framebuffer_size, place, is_radiance ? settings : unchanged);
  }
  if (c.reference_is_shown())
    return view_of(state, reference_slot, c.reference).draw(framebuffer, framebuffer_size, place, settings);
  if (!c.is_active()) return live_.draw(framebuffer, framebuffer_size, place, settings);
  if (const auto map = c.map()) {
    const Pixels pixels(map, &map->pixels);
    const Vec2i size{c.left().frame->width, c.left().frame->height};
    return view_of(state, map_slot, size, pixels).draw(framebuffer, framebuffer_size, place, unchanged);
  }
  // The left image is shown until the first map is computed.
  ImageView& left = view_of(state, left_slot, c.left());
  if (c.mode != CompareMode::wipe) return left.draw(framebuffer, framebuffer_size, place, settings);
  const float x = divider_x(state);
  const float end = place.corner.x + place.size.x;
  const Placement left_part{place.corner, {x - place.corner.x, place.size.y}};
  const Placement right_part{{x, place.corner.y}, {end - x, place.size.y}};
  left.draw(framebuffer, framebuffer_size, place, settings, left_part);
  view_of(state, right_slot, c.right()).draw(framebuffer, framebuffer_size, place, settings, right_part);
}

}  // namespace etendue::viewer
