// The picture on screen: radiance in a texture, the display transform into bytes, the bytes into the viewport.
//
// The transform runs once for each new frame or changed display; a redraw of the interface only copies its result.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "image/display.h"
#include "spectrum/rgb.h"
#include "viewer/platform/platform.h"

namespace etendue::viewer {

struct Shown {
  float exposure = 0;
  image::ToneCurve curve = image::ToneCurve::none;
  bool false_color = false;

  friend bool operator==(const Shown&, const Shown&) = default;
};

// The luminances, as powers of two, at both ends of the false-colour scale.
Vec2 false_color_stops(float exposure);

// Where the picture lies in the window, pixels from the upper left.
struct Placement {
  Vec2 corner{0}, size{1};

  bool contains(Vec2 p) const {
    return p.x >= corner.x && p.y >= corner.y && p.x < corner.x + size.x && p.y < corner.y + size.y;
  }
};

// The pixel of a picture of this size that is shown at a place of the window; the nearest for places beside it.
Vec2i pixel_at(const Placement& shown, Vec2i size, Vec2 at);

class Picture {
 public:
  explicit Picture(const Gl& gl) : gl_(gl) {}
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  Result<void> start();
  bool empty() const { return width_ == 0; }
  Vec2i size() const { return {width_, height_}; }

  void upload(int width, int height, std::span<const Rgb> pixels);
  // Copies the picture to `place` of a target that is `target_size` large; only what lies in `part`, if it is given.
  void draw(GLuint target, Vec2i target_size, const Placement& place, const Shown& shown,
            const std::optional<Placement>& part = {});

 private:
  void transform(const Shown& shown);

  const Gl& gl_;
  GLuint program_ = 0, vertices_ = 0, radiance_ = 0, shown_ = 0, framebuffer_ = 0;
  int width_ = 0, height_ = 0;
  bool stale_ = true;
  Shown last_;
};

// What the framebuffer shows, three bytes a pixel, row 0 on top.
std::vector<uint8_t> read_window(const Gl& gl, GLuint framebuffer, Vec2i size);

}  // namespace etendue::viewer
