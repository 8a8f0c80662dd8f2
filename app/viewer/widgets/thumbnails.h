// Small pictures as textures of the interface, as the display shows them.
#pragma once
#include <memory>
#include <vector>

#include "image/display.h"
#include "viewer/platform/gl.h"

namespace etendue::viewer {

class Thumbnails {
 public:
  explicit Thumbnails(const Gl& gl) : gl_(gl) {}
  ~Thumbnails();
  Thumbnails(const Thumbnails&) = delete;
  Thumbnails& operator=(const Thumbnails&) = delete;

  // Linear pixels, three numbers each.
  struct Source {
    int width = 0, height = 0;
    std::shared_ptr<const std::vector<float>> pixels;
    float exposure = 0;
    image::ToneCurve curve = image::ToneCurve::none;

    friend bool operator==(const Source&, const Source&) = default;
  };
  // The texture of picture `index`, made anew only if its source is another one.
  GLuint texture(size_t index, const Source& source);

 private:
  struct Entry {
    GLuint texture = 0;
    Source source;
  };
  const Gl& gl_;
  std::vector<Entry> entries_;
};

}  // namespace etendue::viewer
