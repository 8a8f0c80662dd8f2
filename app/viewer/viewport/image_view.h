// An image on screen: its radiance in a texture, the display transform, and the copy to the window.
//
// The display transform runs once for each new image or changed display setting. A redraw of the interface only copies
// its result.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "image/display.h"
#include "spectrum/rgb.h"
#include "viewer/platform/gl.h"
#include "viewer/viewport/placement.h"

namespace etendue::viewer {

struct DisplaySettings {
  float exposure = 0;  // EV
  image::ToneCurve curve = image::ToneCurve::none;
  bool false_color = false;

  friend bool operator==(const DisplaySettings&, const DisplaySettings&) = default;
};

// The base-2 logarithms of the luminances at both ends of the false-colour scale.
Vec2 false_color_range(float exposure);

class ImageView {
 public:
  explicit ImageView(const Gl& gl) : gl_(gl) {}
  ~ImageView();
  ImageView(const ImageView&) = delete;
  ImageView& operator=(const ImageView&) = delete;

  // Compiles the shaders; to be called once, before anything else.
  Result<void> start();
  bool empty() const { return width_ == 0; }

  // Sets the image: linear radiance, row 0 on top.
  void upload(int width, int height, std::span<const Rgb> pixels);
  // Draws the image at `placement` of a framebuffer of this size; only the part inside `clip` if that is given.
  void draw(GLuint framebuffer, Vec2i framebuffer_size, const Placement& placement, const DisplaySettings& settings,
            const std::optional<Placement>& clip = {});

 private:
  void apply_display_transform(const DisplaySettings& settings);

  const Gl& gl_;
  GLuint program_ = 0;
  GLuint vertex_array_ = 0;
  GLuint radiance_texture_ = 0;
  GLuint display_texture_ = 0;
  GLuint framebuffer_ = 0;  // renders to the display texture
  int width_ = 0;
  int height_ = 0;
  bool outdated_ = true;  // the display texture does not belong to the radiance texture
  DisplaySettings last_settings_;
};

// The pixels of a framebuffer, three bytes each, row 0 on top.
std::vector<uint8_t> read_pixels(const Gl& gl, GLuint framebuffer, Vec2i size);

}  // namespace etendue::viewer
