#include "viewer/viewport/image_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "spectrum/colormap.h"
#include "viewer/platform/shaders.h"

namespace etendue::viewer {
namespace {

static_assert(sizeof(Rgb) == 3 * sizeof(float));

constexpr int kPaletteColors = 9;
constexpr Vec2 kFalseColorRange(-7, 3);  // stops relative to display white

// From this scale on, pixels are shown as squares.
constexpr float kMinPixelScale = 2;

// The pixels of an image that are visible, and where they appear.
struct VisiblePixels {
  Vec2i from, to;  // `to` is outside
  Placement on_screen;
};

// An enlarged image may extend far beyond the window, so only the pixels that touch `clip` are copied.
VisiblePixels visible_pixels(Vec2i size, const Placement& placement, const Placement& clip) {
  const Vec2 scale = placement.size / Vec2(size);
  const Placement part = intersection(placement, clip);
  // One more pixel at each side, for the interpolation.
  const Vec2i from = glm::max(Vec2i(glm::floor((part.corner - placement.corner) / scale)) - 1, Vec2i(0));
  const Vec2i to = glm::min(Vec2i(glm::ceil((part.corner + part.size - placement.corner) / scale)) + 1, size);
  const Vec2 corner = glm::round(placement.corner + Vec2(from) * scale);
  return {from, to, {corner, glm::round(placement.corner + Vec2(to) * scale) - corner}};
}

// Compile errors are appended to `log`.
GLuint compile_shader(const Gl& gl, GLenum kind, const char* source, std::string& log) {
  const GLuint shader = gl.CreateShader(kind);
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  GLint success = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &success);
  if (!success) {
    char buffer[1024] = "";
    gl.GetShaderInfoLog(shader, sizeof buffer, nullptr, buffer);
    log += buffer;
  }
  return shader;
}

GLuint make_texture(const Gl& gl, GLint filter) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

Vec2 false_color_range(float exposure) { return kFalseColorRange - exposure; }

ImageView::~ImageView() {
  if (program_) gl_.DeleteProgram(program_);
  if (vertex_array_) gl_.DeleteVertexArrays(1, &vertex_array_);
  if (radiance_texture_) gl_.DeleteTextures(1, &radiance_texture_);
  if (display_texture_) gl_.DeleteTextures(1, &display_texture_);
  if (framebuffer_) gl_.DeleteFramebuffers(1, &framebuffer_);
}

Result<void> ImageView::start() {
  std::string log;
  const GLuint vertex = compile_shader(gl_, GL_VERTEX_SHADER, k_screen_vert, log);
  const GLuint fragment = compile_shader(gl_, GL_FRAGMENT_SHADER, k_display_frag, log);
  program_ = gl_.CreateProgram();
  gl_.AttachShader(program_, vertex);
  gl_.AttachShader(program_, fragment);
  gl_.LinkProgram(program_);
  gl_.DeleteShader(vertex);
  gl_.DeleteShader(fragment);
  GLint success = 0;
  gl_.GetProgramiv(program_, GL_LINK_STATUS, &success);
  if (!success) return usage_error("view: the display shader does not compile with this OpenGL driver: " + log);
  gl_.GenVertexArrays(1, &vertex_array_);
  radiance_texture_ = make_texture(gl_, GL_NEAREST);
  display_texture_ = make_texture(gl_, GL_LINEAR);
  gl_.GenFramebuffers(1, &framebuffer_);

  gl_.UseProgram(program_);
  std::array<float, 3 * kPaletteColors> palette;
  for (int i = 0; i < kPaletteColors; ++i) {
    const Rgb c = viridis(static_cast<float>(i) / (kPaletteColors - 1));
    for (int k = 0; k < 3; ++k) palette[static_cast<size_t>(3 * i + k)] = c[k];
  }
  gl_.Uniform3fv(gl_.GetUniformLocation(program_, "palette"), kPaletteColors, palette.data());
  gl_.Uniform1i(gl_.GetUniformLocation(program_, "radiance"), 0);
  return {};
}

void ImageView::upload(int width, int height, std::span<const Rgb> pixels) {
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.BindTexture(GL_TEXTURE_2D, radiance_texture_);
  if (width != width_ || height != height_) {
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, width, height, 0, GL_RGB, GL_FLOAT, pixels.data());
    gl_.BindTexture(GL_TEXTURE_2D, display_texture_);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, display_texture_, 0);
    width_ = width;
    height_ = height;
  } else {
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_FLOAT, pixels.data());
  }
  outdated_ = true;
}

void ImageView::apply_display_transform(const DisplaySettings& settings) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.UseProgram(program_);
  const auto uniform = [&](const char* name) { return gl_.GetUniformLocation(program_, name); };
  gl_.Uniform1f(uniform("scale"), std::exp2(settings.exposure));
  gl_.Uniform1i(uniform("curve"), static_cast<GLint>(settings.curve));
  gl_.Uniform1i(uniform("false_color"), settings.false_color ? 1 : 0);
  const Vec2 range = false_color_range(settings.exposure);
  gl_.Uniform2f(uniform("false_color_range"), range.x, range.y);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, radiance_texture_);
  gl_.BindVertexArray(vertex_array_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.BindVertexArray(0);
  outdated_ = false;
  last_settings_ = settings;
}

void ImageView::draw(GLuint framebuffer, Vec2i framebuffer_size, const Placement& placement,
                     const DisplaySettings& settings, const std::optional<Placement>& clip) {
  if (empty()) return;
  if (outdated_ || !(last_settings_ == settings)) apply_display_transform(settings);
  const VisiblePixels visible = visible_pixels({width_, height_}, placement, clip.value_or(placement));
  if (visible.to.x <= visible.from.x || visible.to.y <= visible.from.y) return;
  // Row 0 of the texture is the top of the image; row 0 of the framebuffer is its bottom.
  const auto x0 = static_cast<GLint>(visible.on_screen.corner.x);
  const auto x1 = static_cast<GLint>(visible.on_screen.corner.x + visible.on_screen.size.x);
  const auto y0 = framebuffer_size.y - static_cast<GLint>(visible.on_screen.corner.y);
  const auto y1 = framebuffer_size.y - static_cast<GLint>(visible.on_screen.corner.y + visible.on_screen.size.y);
  const Vec2 scale = placement.size / Vec2(width_, height_);
  const bool shows_pixels = scale == Vec2(1) || std::min(scale.x, scale.y) >= kMinPixelScale;
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  if (clip) {
    const Vec2i corner(clip->corner);
    const Vec2i end(clip->corner + clip->size);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Scissor(corner.x, framebuffer_size.y - end.y, end.x - corner.x, end.y - corner.y);
  }
  gl_.BlitFramebuffer(visible.from.x, visible.from.y, visible.to.x, visible.to.y, x0, y0, x1, y1, GL_COLOR_BUFFER_BIT,
                      shows_pixels ? GL_NEAREST : GL_LINEAR);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

std::vector<uint8_t> read_pixels(const Gl& gl, GLuint framebuffer, Vec2i size) {
  const size_t row = static_cast<size_t>(size.x) * 3;
  std::vector<uint8_t> bottom_up(row * static_cast<size_t>(size.y));
  std::vector<uint8_t> pixels(bottom_up.size());
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, bottom_up.data());
  for (size_t y = 0; y < static_cast<size_t>(size.y); ++y)
    std::copy_n(bottom_up.data() + (static_cast<size_t>(size.y) - 1 - y) * row, row, pixels.data() + y * row);
  return pixels;
}

}  // namespace etendue::viewer
