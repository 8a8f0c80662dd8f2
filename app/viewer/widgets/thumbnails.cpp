#include "viewer/widgets/thumbnails.h"

namespace etendue::viewer {

Thumbnails::~Thumbnails() {
  for (const Entry& entry : entries_)
    if (entry.texture) gl_->DeleteTextures(1, &entry.texture);
}

ImTextureID Thumbnails::texture(const Gl& gl, size_t index, const ThumbnailImage& image) {
  gl_ = &gl;
  if (entries_.size() <= index) entries_.resize(index + 1);
  Entry& entry = entries_[index];
  const auto id_of = [](GLuint texture) { return reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(texture)); };
  if (entry.texture && entry.image == image) return id_of(entry.texture);
  if (!entry.texture) {
    gl.GenTextures(1, &entry.texture);
    gl.BindTexture(GL_TEXTURE_2D, entry.texture);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  const auto bytes = image::display_pixels(*image.pixels, image.exposure, image.curve);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.BindTexture(GL_TEXTURE_2D, entry.texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, image.width, image.height, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
  entry.image = image;
  return id_of(entry.texture);
}

}  // namespace etendue::viewer
