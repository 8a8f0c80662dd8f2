#include "viewer/files/loader.h"

#include <algorithm>
#include <mutex>

#include "image/format.h"
#include "image/image.h"
#include "render/checkpoint.h"
#include "render/document_of_scene.h"
#include "render/image_output.h"
#include "render/session_file.h"
#include "render/state_difference.h"
#include "viewer/files/file_names.h"
#include "viewer/files/loading_picture.h"

namespace etendue::viewer {

struct Loader::Shared {
  std::mutex mutex;
  std::shared_ptr<const StoredPicture> picture;
};

namespace {

using Kind = OpenedFile::Kind;

Result<OpenedFile> read_environment(const std::string& file, const render::Document& current) {
  if (!current.scene)
    return usage_error(file + ": is an environment map, but no scene is open; open a .gltf or .glb file first");
  auto document = render::with_environment(current, file);
  if (!document) return document.error();
  return OpenedFile{.kind = Kind::environment, .file = file, .document = std::move(*document)};
}

bool is_image(const std::string& extension) {
  const auto extensions = image::readable_extensions();
  return std::ranges::find(extensions, extension) != extensions.end();
}

// The image that was displayed; null if the file has no colours.
std::shared_ptr<const StoredPicture> picture_of(const image::LayeredImage& image, const std::string& state) {
  const image::Layer* layer = image.find("reweighted");
  if (!layer) layer = image.find("");
  if (!layer || layer->channels.size() != 3) return nullptr;
  auto picture = std::make_shared<StoredPicture>();
  picture->width = image.width;
  picture->height = image.height;
  picture->display = render::display_from_state(state);
  picture->pixels = image::rgb_pixels(*layer);
  return picture;
}

// From the checkpoint beside an image; nothing if there is none, or if it has other settings than the image.
std::optional<render::ResumePoint> resume_point_of(const std::string& file, const std::string& state,
                                                   const render::Document& document) {
  const std::string name = render::checkpoint_of_image(file);
  std::error_code code;
  if (!std::filesystem::exists(name, code)) return std::nullopt;
  auto checkpoint = render::read_checkpoint(name);
  const bool fits = checkpoint && render::same_settings(checkpoint->state, state) && document.part.is_whole() &&
                    checkpoint->film.width() == document.width && checkpoint->film.height() == document.height;
  if (!fits) return std::nullopt;
  render::ResumePoint point(std::move(checkpoint->film), std::move(checkpoint->integrator_state),
                            std::move(checkpoint->tails));
  point.seconds = checkpoint->seconds;
  return point;
}

Result<OpenedFile> read_snapshot(const std::string& file, const image::LayeredImage& image, const std::string& state,
                                 const ShowPicture& show) {
  show(picture_of(image, state));
  auto document = render::document_from_state(state, file);
  if (!document) return document.error();
  auto resume_point = resume_point_of(file, state, *document);
  return OpenedFile{.kind = Kind::snapshot,
                    .file = file,
                    .document = std::move(*document),
                    .resume_point = std::move(resume_point)};
}

Result<OpenedFile> read(const std::string& file, const render::Document& current, const std::string& environment,
                        const ShowPicture& show) {
  const std::string extension = lower_extension(file);
  if (extension == ".exr") {
    const auto image = image::read_exr(file);
    if (!image) return image.error();
    const auto state = image->attributes.find(render::kStateAttribute);
    if (state == image->attributes.end()) return read_environment(file, current);
    return read_snapshot(file, *image, state->second, show);
  }
  if (extension == render::kSessionExtension) {
    auto document = render::read_session_file(file);
    if (!document) return document.error();
    return OpenedFile{.kind = Kind::session, .file = file, .document = std::move(*document)};
  }
  if (is_image(extension)) return read_environment(file, current);
  LoadingPicture picture(file, environment, show);
  scene::LoadOptions options;
  options.without_images = [&](const scene::Scene& scene) { picture.start(scene); };
  auto document = render::new_document(file, "", options);
  if (!document) return document.error();
  if (document->lit_by_default && !environment.empty()) document = render::with_environment(*document, environment);
  if (!document) return document.error();
  return OpenedFile{.kind = Kind::scene, .file = file, .document = std::move(*document)};
}

}  // namespace

void Loader::open(const std::string& file, const render::Document& current, const std::string& environment) {
  file_ = file;
  start_ = std::chrono::steady_clock::now();
  shared_ = std::make_shared<Shared>();
  const auto show = [shared = shared_, wake = wake_](std::shared_ptr<const StoredPicture> picture) {
    {
      const std::lock_guard lock(shared->mutex);
      shared->picture = std::move(picture);
    }
    wake();
  };
  task_.start([file, current, environment, show] { return read(file, current, environment, show); }, wake_);
}

std::shared_ptr<const StoredPicture> Loader::picture() const {
  if (!shared_ || !is_busy()) return nullptr;
  const std::lock_guard lock(shared_->mutex);
  return shared_->picture;
}

void Loader::recover(const std::string& journal) {
  file_ = journal;
  shared_.reset();
  start_ = std::chrono::steady_clock::now();
  const auto work = [journal]() -> Result<OpenedFile> {
    auto document = render::read_session_file(journal);
    if (!document) return document.error();
    return OpenedFile{.kind = Kind::recovered, .file = journal, .document = std::move(*document)};
  };
  task_.start(work, wake_);
}

double Loader::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace etendue::viewer
