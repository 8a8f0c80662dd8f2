// A small image and how it is displayed.
#pragma once
#include <memory>
#include <vector>

#include "image/display.h"

namespace etendue::viewer {

// Linear radiance, three numbers per pixel, and how it is displayed.
struct ThumbnailImage {
  int width = 0;
  int height = 0;
  std::shared_ptr<const std::vector<float>> pixels;
  float exposure = 0;
  image::ToneCurve curve = image::ToneCurve::none;

  friend bool operator==(const ThumbnailImage&, const ThumbnailImage&) = default;
};

}  // namespace etendue::viewer
