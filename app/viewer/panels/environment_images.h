// The built-in environments as images, side by side; a click lights the scene with one of them.
#pragma once
#include <vector>

#include "viewer/widgets/thumbnails.h"

namespace etendue::viewer {

struct AppState;

class EnvironmentImages {
 public:
  void draw(AppState& state);

 private:
  std::vector<ThumbnailImage> images_;
  Thumbnails textures_;
};

}  // namespace etendue::viewer
