#include "viewer/widgets/thumbnails.h"

namespace etendue::viewer {

Thumbnails::~Thumbnails() {
  for (const Entry& entry : entries_)
    if (entry.texture) gl_.DeleteTextures(1, &entry.texture);
}

GLuint Thumbnails::texture(size_t index, const Source& source) {
  if (entries_.size() <= index) entries_.resize(index + 1);
  Entry& entry = entries_[index];
  if (entry.texture && entry.source == source) return entry.texture;
  if (!entry.texture) {
    gl_.GenTextures(1, &entry.texture);
    gl_.BindTexture(GL_TEXTURE_2D, entry.texture);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  const auto bytes = image::display_pixels(*source.pixels, source.exposure, source.curve);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.BindTexture(GL_TEXTURE_2D, entry.texture);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, source.width, source.height, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
  entry.source = source;
  return entry.texture;
}

}  // namespace etendue::viewer
