#include "viewer/viewport/comparison_view.h"

#include "viewer/layout/interface.h"

namespace etendue::viewer {

Picture& SplitScreen::uploaded(const Workbench& w, Role role, Vec2i size, const Pixels& pixels) {
  // The live picture holds a layer while one is shown; nothing is compared then.
  if (pixels == w.frame->pixels) return live_;
  Slot& slot = slots_[role];
  if (!slot.picture) {
    auto made = std::make_unique<Picture>(gl_);
    if (!made->start()) return live_;
    slot.picture = std::move(made);
  }
  if (slot.pixels != pixels) slot.picture->upload(size.x, size.y, *pixels);
  slot.pixels = pixels;
  return *slot.picture;
}

Picture& SplitScreen::uploaded(const Workbench& w, Role role, const Side& side) {
  return uploaded(w, role, {side.frame->width, side.frame->height}, side.frame->pixels);
}

void SplitScreen::draw(const Workbench& w, GLuint target, Vec2i target_size) {
  const Placement& place = w.view.picture;
  const auto& display = w.editor.document().display;
  const Shown shown{display.exposure, display.curve, w.view.false_color};
  const Comparison& c = w.comparison;
  if (w.shows_layer()) return live_.draw(target, target_size, place, Shown{});
  if (c.reference_on_screen()) return uploaded(w, reference, c.reference).draw(target, target_size, place, shown);
  if (!c.active()) return live_.draw(target, target_size, place, shown);
  if (const auto made = c.map()) {
    const Pixels painted(made, &made->painted);
    return uploaded(w, map, {c.left().frame->width, c.left().frame->height}, painted)
        .draw(target, target_size, place, Shown{});
  }
  // A map that is still being made has the left side in its place.
  Picture& first = uploaded(w, left, c.left());
  if (c.mode != CompareMode::wipe) return first.draw(target, target_size, place, shown);
  const float x = divider_x(w), end = place.corner.x + place.size.x;
  const Placement parts[2] = {{place.corner, {x - place.corner.x, place.size.y}},
                              {{x, place.corner.y}, {end - x, place.size.y}}};
  first.draw(target, target_size, place, shown, parts[0]);
  uploaded(w, right, c.right()).draw(target, target_size, place, shown, parts[1]);
}

}  // namespace etendue::viewer
