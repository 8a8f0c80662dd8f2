// Pictures that are shown while a file is being opened.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "render/document.h"

namespace etendue::viewer {

struct StoredPicture {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;
  render::Display display;  // how it is displayed
};

using ShowPicture = std::function<void(std::shared_ptr<const StoredPicture>)>;

}  // namespace etendue::viewer
