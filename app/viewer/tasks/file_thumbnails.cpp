#include "viewer/tasks/file_thumbnails.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "film/film_image.h"
#include "image/image.h"
#include "render/automatic_exposure.h"
#include "render/image_output.h"
#include "render/material_settings.h"
#include "render/session.h"
#include "render/session_file.h"
#include "scene/builtin/builtin.h"
#include "scene/preview.h"
#include "viewer/files/file_names.h"

namespace etendue::viewer {
namespace {

constexpr int kLargestSide = 192;  // pixels
constexpr uint32_t kThumbnailSamples = 16;
constexpr uintmax_t kLargestFile = 64 << 20;  // larger files take too long

struct Size {
  int width, height;
};

Size fitted(int width, int height) {
  const float scale = std::min(1.0f, static_cast<float>(kLargestSide) / static_cast<float>(std::max(width, height)));
  const auto side = [scale](int length) {
    return std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(length))));
  };
  return {side(width), side(height)};
}

// Means over the pixels that each small pixel covers.
std::vector<float> reduced(const std::vector<float>& pixels, Size from, Size to) {
  std::vector<float> small(static_cast<size_t>(to.width) * static_cast<size_t>(to.height) * 3);
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x) {
      const int x0 = x * from.width / to.width, x1 = std::max(x0 + 1, (x + 1) * from.width / to.width);
      const int y0 = y * from.height / to.height, y1 = std::max(y0 + 1, (y + 1) * from.height / to.height);
      float* out = &small[3 * (static_cast<size_t>(y) * static_cast<size_t>(to.width) + static_cast<size_t>(x))];
      for (int j = y0; j < y1; ++j)
        for (int i = x0; i < x1; ++i) {
          const size_t at = 3 * (static_cast<size_t>(j) * static_cast<size_t>(from.width) + static_cast<size_t>(i));
          for (size_t c = 0; c < 3; ++c) out[c] += pixels[at + c] / static_cast<float>((x1 - x0) * (y1 - y0));
        }
    }
  return small;
}

// The exposure that suits an image whose surfaces are not known.
float exposure_of(const std::vector<float>& pixels, float exposure) {
  std::vector<float> luminances;
  for (size_t i = 0; i + 2 < pixels.size(); i += 3) {
    const float value = luminance(Rgb(pixels[i], pixels[i + 1], pixels[i + 2]));
    luminances.push_back(value > 0 ? value : 0);  // NaN counts as black
  }
  std::ranges::sort(luminances);
  if (!render::exposure_is_unsuitable(luminances, exposure)) return exposure;
  return render::automatic_exposure(luminances).value_or(exposure);
}

ThumbnailImage make_image(Size size, std::vector<float> pixels, const render::Display& display) {
  const float exposure = exposure_of(pixels, display.exposure);
  return {.width = size.width,
          .height = size.height,
          .pixels = std::make_shared<const std::vector<float>>(std::move(pixels)),
          .exposure = exposure,
          .curve = display.curve};
}

ThumbnailImage rendered_image(render::Document document) {
  const Size size = fitted(document.width, document.height);
  document.width = size.width;
  document.height = size.height;
  return make_image(size, film::radiance_of(render::rendered(document, kThumbnailSamples, 1)), document.display);
}

Result<ThumbnailImage> reduced_image(const std::string& file) {
  const auto image = image::read_linear(file);
  if (!image) return image.error();
  const Size from{image->width, image->height}, to = fitted(from.width, from.height);
  const auto text = image->attributes.find(render::kStateAttribute);
  ThumbnailImage small = make_image(to, reduced(image->layers.front().pixels, from, to), {});
  if (text == image->attributes.end()) return small;
  // A snapshot is shown as it was, whatever suits its pixels.
  const render::Display display = render::display_from_state(text->second);
  small.exposure = display.exposure;
  small.curve = display.curve;
  return small;
}

// The material on a sphere in studio light.
Result<ThumbnailImage> material_image(const std::string& file) {
  constexpr int kSide = 128;  // pixels
  render::Document document;
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.emplace_back();
  document.scene = scene;
  const auto loaded = render::with_material_file(document, 0, file);
  if (!loaded) return loaded.error();
  document.scene = std::make_shared<scene::Scene>(
      scene::preview_scene(*loaded->scene, loaded->scene->materials[0], scene::PreviewLight::studio));
  document.camera = scene::preview_camera();
  document.width = document.height = kSide;
  return rendered_image(std::move(document));
}

Result<ThumbnailImage> make_thumbnail(const std::string& file) {
  std::error_code code;
  const bool is_builtin = scene::find_builtin(file) != nullptr;
  if (!is_builtin && std::filesystem::file_size(file, code) > kLargestFile) return input_error(file + ": is too large");
  const std::string extension = lower_extension(file);
  if (extension == render::kMaterialExtension) return material_image(file);
  const bool is_session = extension == render::kSessionExtension;
  if (!is_builtin && !is_session && extension != ".gltf" && extension != ".glb") return reduced_image(file);
  auto document = is_session ? render::read_session_file(file) : render::new_document(file);
  if (!document) return document.error();
  return rendered_image(std::move(*document));
}

}  // namespace

bool FileThumbnails::Queue::contains(const std::string& file) const {
  return std::ranges::find(files_, file) != files_.end();
}

void FileThumbnails::Queue::clear_after_first() {
  if (files_.size() > 1) files_.resize(1);
}

std::optional<std::string> FileThumbnails::Queue::front() const {
  if (files_.empty()) return {};
  return files_.front();
}

const ThumbnailImage* FileThumbnails::find(const std::string& file) {
  take_result();
  const auto known = images_.find(file);
  if (known != images_.end()) return known->second ? &*known->second : nullptr;
  if (!queue_.contains(file)) queue_.push(file);
  start_next();
  return nullptr;
}

void FileThumbnails::cancel_waiting() { queue_.clear_after_first(); }

void FileThumbnails::take_result() {
  auto result = task_.take_result();
  if (!result) return;
  std::optional<ThumbnailImage> image;
  if (*result) image = std::move(**result);
  images_[*queue_.front()] = std::move(image);
  queue_.pop();
  start_next();
}

void FileThumbnails::start_next() {
  const auto file = queue_.front();
  if (!file || task_.running()) return;
  task_.start([file = *file] { return make_thumbnail(file); }, wake_);
}

}  // namespace etendue::viewer
