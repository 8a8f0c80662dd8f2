// Small images as textures, displayed like the main image.
#pragma once
#include <imgui.h>

#include <vector>

#include "viewer/platform/gl.h"
#include "viewer/widgets/thumbnail_image.h"

namespace etendue::viewer {

class Thumbnails {
 public:
  Thumbnails() = default;
  ~Thumbnails();
  Thumbnails(const Thumbnails&) = delete;
  Thumbnails& operator=(const Thumbnails&) = delete;

  // The texture of the image with this index. It is uploaded if the image differs from that of the last call. All calls
  // have the same `gl`, which outlives this object.
  ImTextureID texture(const Gl& gl, size_t index, const ThumbnailImage& image);

 private:
  struct Entry {
    GLuint texture = 0;
    ThumbnailImage image;
  };
  const Gl* gl_ = nullptr;
  std::vector<Entry> entries_;
};

}  // namespace etendue::viewer
