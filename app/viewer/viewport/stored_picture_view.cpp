#include "viewer/viewport/stored_picture_view.h"

#include "viewer/files/loader.h"
#include "viewer/state/app_state.h"

namespace etendue::viewer {

void StoredPictureView::draw(const AppState& state, GLuint framebuffer, Vec2i framebuffer_size) {
  const auto& picture = state.viewport.stored_picture;
  if (!image_ && !image_.emplace(gl_).start()) return image_.reset();
  if (picture != uploaded_) image_->upload(picture->width, picture->height, picture->pixels);
  uploaded_ = picture;
  const Placement place = fit_inside(state.viewport.region, {picture->width, picture->height});
  image_->draw(framebuffer, framebuffer_size, place,
               {.exposure = picture->display.exposure, .curve = picture->display.curve});
}

}  // namespace etendue::viewer
