// Images that a projector light throws.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "base/vec.h"
#include "spectrum/rgb.h"

namespace etendue {

// Linear RGB, without negative or infinite values. The first row is at the top.
class ProjectedImage {
 public:
  ProjectedImage(int width, int height, std::vector<Rgb> pixels)
      : width_(width), height_(height), pixels_(std::move(pixels)) {}

  float aspect() const { return static_cast<float>(width_) / static_cast<float>(height_); }
  // Interpolated between pixel centres and constant beyond them. (0, 0) is the upper left corner, (1, 1) the lower
  // right one.
  Rgb value(Vec2 uv) const;
  Rgb largest() const;

 private:
  const Rgb& pixel(int x, int y) const {
    return pixels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  }

  int width_, height_;
  std::vector<Rgb> pixels_;
};

// Names of images that the program computes; the first one is a window with panes.
extern const std::array<Option, 3> kProjectedImages;

// An image by such a name or by the path of a file. Files are read once. A source that `accepts_projected_image` rejects
// is the first image.
std::shared_ptr<const ProjectedImage> projected_image(const std::string& source);
Result<void> accepts_projected_image(std::string_view source);

}  // namespace etendue
