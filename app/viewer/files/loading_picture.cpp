#include "viewer/files/loading_picture.h"

#include <condition_variable>
#include <mutex>

#include "render/automatic_exposure.h"
#include "render/document_of_scene.h"

namespace etendue::viewer {

void LoadingPicture::start(const scene::Scene& scene) {
  waiting_ = std::jthread([this, scene](const std::stop_token& stop) {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any().wait_for(lock, stop, kPatience, [] { return false; });
    if (!stop.stop_requested()) render(scene);
  });
}

void LoadingPicture::render(const scene::Scene& scene) {
  auto document = render::document_of(scene, file_);
  if (document && document->lit_by_default && !environment_.empty())
    document = render::with_environment(*document, environment_);
  if (!document) return;  // the result of the loading states the error
  document_ = std::move(*document);
  // One thread, since the others decode the textures.
  session_ = std::make_unique<render::Session>(render::SessionOptions{.threads = 1, .interactive = true});
  session_->on_update([this] { update(); });
  session_->submit(document_);
}

void LoadingPicture::update() {
  const auto frame = session_->frame();
  const auto scene = session_->scene();
  if (!frame || !scene) return;
  auto picture = std::make_shared<StoredPicture>();
  picture->width = frame->width;
  picture->height = frame->height;
  picture->pixels = *frame->pixels;
  picture->display = document_.display;
  const auto luminances = render::surface_luminances(document_, *scene, picture->pixels);
  if (render::exposure_is_unsuitable(luminances, picture->display.exposure))
    picture->display.exposure = render::automatic_exposure(luminances).value_or(picture->display.exposure);
  show_(std::move(picture));
  if (frame->samples > 0) session_->stop();
}

}  // namespace etendue::viewer
