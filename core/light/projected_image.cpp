#include "light/projected_image.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "image/image.h"

namespace etendue {

Rgb ProjectedImage::value(Vec2 uv) const {
  const float x = std::clamp(uv.x * static_cast<float>(width_) - 0.5f, 0.0f, static_cast<float>(width_ - 1));
  const float y = std::clamp(uv.y * static_cast<float>(height_) - 0.5f, 0.0f, static_cast<float>(height_ - 1));
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, width_ - 1), bottom = std::min(top + 1, height_ - 1);
  const float s = x - static_cast<float>(left), t = y - static_cast<float>(top);
  return (pixel(left, top) * (1 - s) + pixel(right, top) * s) * (1 - t) +
         (pixel(left, bottom) * (1 - s) + pixel(right, bottom) * s) * t;
}

Rgb ProjectedImage::largest() const {
  return *std::ranges::max_element(pixels_, {}, [](const Rgb& c) { return luminance(c); });
}

const std::array<Option, 3> kProjectedImages{
    {{"window", "Window"}, {"bars", "Colour bars"}, {"checkerboard", "Checkerboard"}}};

namespace {

constexpr int kSize = 256;

// Coordinates from 0 to 1; y points down.
Rgb window_at(float x, float y) {
  const auto is_pane = [](float at, int panes) {
    const float inside = at * static_cast<float>(panes);
    const float edge = std::abs(inside - std::floor(inside) - 0.5f);
    return edge < 0.45f;
  };
  return Rgb(is_pane(x, 3) && is_pane(y, 3) ? 1.0f : 0.0f);
}

Rgb bars_at(float x, float) {
  constexpr Rgb kBars[] = {{1, 1, 1}, {1, 1, 0}, {0, 1, 1}, {0, 1, 0}, {1, 0, 1}, {1, 0, 0}, {0, 0, 1}};
  return kBars[std::min(static_cast<size_t>(x * 7), size_t{6})];
}

Rgb checkerboard_at(float x, float y) {
  return Rgb((static_cast<int>(x * 8) + static_cast<int>(y * 8)) % 2 == 0 ? 1.0f : 0.0f);
}

ProjectedImage computed_image(Rgb (*value)(float, float)) {
  std::vector<Rgb> pixels;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      pixels.push_back(value((static_cast<float>(x) + 0.5f) / kSize, (static_cast<float>(y) + 0.5f) / kSize));
  return {kSize, kSize, std::move(pixels)};
}

Result<ProjectedImage> read_projected_image(const std::string& path) {
  const auto read = image::read_linear(path);
  if (!read) return read.error();
  const image::Layer* beauty = read->find("");
  if (!beauty || beauty->channels.empty() || read->width < 1 || read->height < 1)
    return input_error(path + ": has no colour channels; an image in RGB or grey is expected");
  const size_t stride = beauty->channels.size();
  std::vector<Rgb> pixels;
  for (size_t i = 0; i + stride <= beauty->pixels.size(); i += stride) {
    Rgb color;
    for (size_t c = 0; c < 3; ++c) {
      const float v = beauty->pixels[i + (stride < 3 ? 0 : c)];
      color[static_cast<int>(c)] = std::isfinite(v) && v > 0 ? v : 0.0f;
    }
    pixels.push_back(color);
  }
  return ProjectedImage(read->width, read->height, std::move(pixels));
}

Result<ProjectedImage> projected_image_from(const std::string& source) {
  if (source == kProjectedImages[0].name) return computed_image(window_at);
  if (source == kProjectedImages[1].name) return computed_image(bars_at);
  if (source == kProjectedImages[2].name) return computed_image(checkerboard_at);
  return read_projected_image(source);
}

// Errors are not cached: the file may appear or be corrected.
Result<std::shared_ptr<const ProjectedImage>> cached_image(const std::string& source) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const ProjectedImage>, std::less<>> images;
  const std::scoped_lock lock(mutex);
  auto& image = images[source];
  if (!image) {
    auto made = projected_image_from(source);
    if (!made) return made.error();
    image = std::make_shared<const ProjectedImage>(std::move(*made));
  }
  return image;
}

}  // namespace

std::shared_ptr<const ProjectedImage> projected_image(const std::string& source) {
  const auto image = cached_image(source);
  return image ? *image : *cached_image(kProjectedImages.front().name);
}

Result<void> accepts_projected_image(std::string_view source) {
  const auto image = cached_image(std::string(source));
  if (!image) return image.error();
  return {};
}

}  // namespace etendue
