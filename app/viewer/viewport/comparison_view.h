// Draws the image of the viewport: the live image, an AOV, two images with a divider, a difference map, or the
// reference.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "viewer/platform/gl.h"
#include "viewer/viewport/image_view.h"

namespace etendue::viewer {

struct AppState;
struct Side;

class ComparisonView {
 public:
  // `live` has the live image, or the AOV while one is shown.
  ComparisonView(const Gl& gl, ImageView& live) : gl_(gl), live_(live) {}

  void draw(const AppState& state, GLuint framebuffer, Vec2i framebuffer_size);

 private:
  using Pixels = std::shared_ptr<const std::vector<Rgb>>;
  struct Slot {
    std::unique_ptr<ImageView> image;
    Pixels pixels;
  };
  enum SlotIndex { left_slot, right_slot, reference_slot, map_slot, kSlots };

  // The view with these pixels, which are uploaded once.
  ImageView& view_of(const AppState& state, SlotIndex slot, Vec2i size, const Pixels& pixels);
  ImageView& view_of(const AppState& state, SlotIndex slot, const Side& side);

  const Gl& gl_;
  ImageView& live_;
  std::array<Slot, kSlots> slots_;
};

// The horizontal position of the divider in the window, in whole pixels.
float divider_x(const AppState& state);

}  // namespace etendue::viewer
