#include "viewer/viewport/image_view.h"

#include <cmath>

#include "spectrum/colormap.h"
#include "viewer/platform/shaders.h"

namespace etendue::viewer {
namespace {

static_assert(sizeof(Rgb) == 3 * sizeof(float));

constexpr int kPaletteStops = 9;
constexpr Vec2 kFalseColorStops(-7, 3);  // around what the exposure makes white

GLuint compiled(const Gl& gl, GLenum kind, const char* text, std::string& log) {
  const GLuint shader = gl.CreateShader(kind);
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint fine = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &fine);
  if (!fine) {
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

Vec2 false_color_stops(float exposure) { return kFalseColorStops - exposure; }

Vec2i pixel_at(const Placement& shown, Vec2i size, Vec2 at) {
  return glm::clamp(Vec2i(glm::floor((at - shown.corner) / shown.size * Vec2(size))), Vec2i(0), size - 1);
}

Picture::~Picture() {
  if (program_) gl_.DeleteProgram(program_);
  if (vertices_) gl_.DeleteVertexArrays(1, &vertices_);
  if (radiance_) gl_.DeleteTextures(1, &radiance_);
  if (shown_) gl_.DeleteTextures(1, &shown_);
  if (framebuffer_) gl_.DeleteFramebuffers(1, &framebuffer_);
}

Result<void> Picture::start() {
  std::string log;
  const GLuint vertex = compiled(gl_, GL_VERTEX_SHADER, k_screen_vert, log);
  const GLuint fragment = compiled(gl_, GL_FRAGMENT_SHADER, k_display_frag, log);
  program_ = gl_.CreateProgram();
  gl_.AttachShader(program_, vertex);
  gl_.AttachShader(program_, fragment);
  gl_.LinkProgram(program_);
  gl_.DeleteShader(vertex);
  gl_.DeleteShader(fragment);
  GLint fine = 0;
  gl_.GetProgramiv(program_, GL_LINK_STATUS, &fine);
  if (!fine) return usage_error("view: the display shader does not compile on this OpenGL: " + log);
  gl_.GenVertexArrays(1, &vertices_);
  radiance_ = make_texture(gl_, GL_NEAREST);
  shown_ = make_texture(gl_, GL_LINEAR);
  gl_.GenFramebuffers(1, &framebuffer_);

  gl_.UseProgram(program_);
  std::array<float, 3 * kPaletteStops> palette;
  for (int i = 0; i < kPaletteStops; ++i) {
    const Rgb c = viridis(static_cast<float>(i) / (kPaletteStops - 1));
    for (int k = 0; k < 3; ++k) palette[static_cast<size_t>(3 * i + k)] = c[k];
  }
  gl_.Uniform3fv(gl_.GetUniformLocation(program_, "palette"), kPaletteStops, palette.data());
  gl_.Uniform1i(gl_.GetUniformLocation(program_, "radiance"), 0);
  return {};
}

void Picture::upload(int width, int height, std::span<const Rgb> pixels) {
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.BindTexture(GL_TEXTURE_2D, radiance_);
  if (width != width_ || height != height_) {
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, width, height, 0, GL_RGB, GL_FLOAT, pixels.data());
    gl_.BindTexture(GL_TEXTURE_2D, shown_);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, shown_, 0);
    width_ = width, height_ = height;
  } else {
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_FLOAT, pixels.data());
  }
  stale_ = true;
}

void Picture::transform(const Shown& shown) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.UseProgram(program_);
  const auto at = [&](const char* name) { return gl_.GetUniformLocation(program_, name); };
  gl_.Uniform1f(at("scale"), std::exp2(shown.exposure));
  gl_.Uniform1i(at("curve"), static_cast<GLint>(shown.curve));
  gl_.Uniform1i(at("false_color"), shown.false_color ? 1 : 0);
  const Vec2 stops = false_color_stops(shown.exposure);
  gl_.Uniform2f(at("stops"), stops.x, stops.y);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, radiance_);
  gl_.BindVertexArray(vertices_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.BindVertexArray(0);
  stale_ = false;
  last_ = shown;
}

void Picture::draw(GLuint target, Vec2i target_size, const Placement& place, const Shown& shown,
                   const std::optional<Placement>& part) {
  if (empty()) return;
  if (stale_ || !(last_ == shown)) transform(shown);
  // Row 0 of the texture is the top of the picture, row 0 of the window is its bottom.
  const auto x0 = static_cast<GLint>(place.corner.x), x1 = static_cast<GLint>(place.corner.x + place.size.x);
  const auto y0 = target_size.y - static_cast<GLint>(place.corner.y);
  const auto y1 = target_size.y - static_cast<GLint>(place.corner.y + place.size.y);
  const bool exact = x1 - x0 == width_ && y0 - y1 == height_;
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  if (part) {
    const Vec2i corner(part->corner), end(part->corner + part->size);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Scissor(corner.x, target_size.y - end.y, end.x - corner.x, end.y - corner.y);
  }
  gl_.BlitFramebuffer(0, 0, width_, height_, x0, y0, x1, y1, GL_COLOR_BUFFER_BIT, exact ? GL_NEAREST : GL_LINEAR);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target);
}

std::vector<uint8_t> read_window(const Gl& gl, GLuint framebuffer, Vec2i size) {
  const size_t row = static_cast<size_t>(size.x) * 3;
  std::vector<uint8_t> upside_down(row * static_cast<size_t>(size.y)), pixels(upside_down.size());
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
  for (size_t y = 0; y < static_cast<size_t>(size.y); ++y)
    std::copy_n(upside_down.data() + (static_cast<size_t>(size.y) - 1 - y) * row, row, pixels.data() + y * row);
  return pixels;
}

}  // namespace etendue::viewer
