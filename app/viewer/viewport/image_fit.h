// The resolution of the image follows the size of the viewport, so that one pixel of the image is one of the screen.
#pragma once
#include <vector>

#include "base/vec.h"
#include "render/clock.h"

namespace etendue::render {
struct Document;
}

namespace etendue::viewer {

struct AppState;

// The size of an image that fills a region, with the aspect ratio of the camera if that has one.
Vec2i fitted_size(const render::Document& document, Vec2 region);
void fit_image(render::Document& document, Vec2 region);

// Fits the image again when the viewport has kept another size for a moment. The image stays as it is if the user has
// chosen its resolution, if other images are compared with it, if something was measured in it, or if its samples have
// taken so long that they should be kept.
class ImageFit {
 public:
  // The document was opened. `is_fitted`: its image has the size of the viewport.
  void reset(const render::Document& document, bool is_fitted);
  void update(AppState& state);

 private:
  std::vector<Vec2i> sizes_;  // that were fitted to the viewport, not chosen by the user
  Vec2 region_{0};
  render::Clock::time_point resized_;
};

}  // namespace etendue::viewer
