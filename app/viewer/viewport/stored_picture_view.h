// Draws the picture of a snapshot while its scene is being opened.
#pragma once
#include <memory>
#include <optional>

#include "viewer/platform/gl.h"
#include "viewer/viewport/image_view.h"

namespace etendue::viewer {

struct AppState;
struct StoredPicture;

class StoredPictureView {
 public:
  explicit StoredPictureView(const Gl& gl) : gl_(gl) {}

  // Fits the picture into the viewport, with the display settings of the snapshot. There must be a picture.
  void draw(const AppState& state, GLuint framebuffer, Vec2i framebuffer_size);

 private:
  const Gl& gl_;
  std::optional<ImageView> image_;
  std::shared_ptr<const StoredPicture> uploaded_;
};

}  // namespace etendue::viewer
