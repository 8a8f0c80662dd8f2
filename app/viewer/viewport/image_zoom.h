// Pan and zoom of the image in the viewport. The camera and the rendering do not depend on it.
#pragma once
#include "base/vec.h"
#include "viewer/viewport/placement.h"

namespace etendue::viewer {

struct AppState;

// Which part of the image is shown, and how large.
struct ImageZoom {
  float scale = 0;    // window pixels per image pixel; 0 fits the image into the viewport
  Vec2 centre{0.5f};  // point of the image in the middle of the viewport, relative to the size of the image

  bool is_fitted() const { return scale == 0; }
};

inline constexpr float kMinZoom = 1.0f / 16, kMaxZoom = 32;

// The rectangle of the window that the whole image would fill; it may extend beyond the viewport.
Placement placement_of(const ImageZoom& zoom, const Placement& region, Vec2i image_size);

// The zoom after scaling by a factor. The point of the image at `position` of the window stays there as far as the
// viewport remains filled.
ImageZoom scaled(const AppState& state, float factor, Vec2 position);
// The zoom after moving the image by this many window pixels. A fitted image does not move.
ImageZoom moved(const AppState& state, Vec2 movement);

// The size of the image in the viewport: of the rendering, or of two stored images that are compared.
Vec2i shown_image_size(const AppState& state);
// Window pixels per image pixel at present.
float current_scale(const AppState& state);
// Shows the image at this scale about the middle of the viewport; 0 fits it into the viewport.
void set_scale(AppState& state, float scale);

}  // namespace etendue::viewer
