#include "material/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "image/tiled_image.h"
#include "spectrum/rgb.h"

namespace etendue {
namespace {

template <class F>
std::array<float, 256> table_of(F value) {
  std::array<float, 256> table{};
  for (size_t i = 0; i < table.size(); ++i) table[i] = value(static_cast<float>(i));
  return table;
}

// Linear values of bytes with both encodings.
const std::array<float, 256> kSrgb = table_of([](float byte) { return srgb_to_linear(byte / 255.0f); });
const std::array<float, 256> kLinear = table_of([](float byte) { return byte * (1 / 255.0f); });

// The texel index i of a row of n texels, wrapped into [0, n).
int wrapped(int i, int n, Wrap wrap) {
  if (static_cast<unsigned>(i) < static_cast<unsigned>(n)) return i;
  if (wrap == Wrap::clamp) return i < 0 ? 0 : n - 1;
  const int period = wrap == Wrap::mirror ? 2 * n : n;
  int m = i % period;
  if (m < 0) m += period;
  return m < n ? m : period - 1 - m;
}

// RGBA from one to four channels.
Vec4 to_rgba(const float* v, int channels) {
  switch (channels) {
    case 1:
      return Vec4(v[0], v[0], v[0], 1);
    case 2:
      return Vec4(v[0], v[0], v[0], v[1]);
    case 3:
      return Vec4(v[0], v[1], v[2], 1);
    default:
      return Vec4(v[0], v[1], v[2], v[3]);
  }
}

// RGBA of a byte pixel with 1 to 4 channels. Alpha is linear in both encodings.
Vec4 decoded(const uint8_t* bytes, int channels, Encoding encoding) {
  const float* table = encoding == Encoding::srgb ? kSrgb.data() : kLinear.data();
  if (channels < 3) {
    const float grey = table[bytes[0]];
    return Vec4(grey, grey, grey, channels == 2 ? kLinear[bytes[1]] : 1);
  }
  return Vec4(table[bytes[0]], table[bytes[1]], table[bytes[2]], channels == 4 ? kLinear[bytes[3]] : 1);
}

Vec4 texel(const image::Image& image, Encoding encoding, int x, int y) {
  const size_t at = (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)) *
                    static_cast<size_t>(image.channels);
  if (image.type == image::PixelType::float32) return to_rgba(&image.floats[at], image.channels);
  return decoded(&image.bytes[at], image.channels, encoding);
}

// Replaces coordinates whose texel index would overflow by 0.
float bounded(float x) { return std::abs(x) < 1e6f ? x : 0; }

// The four texels around a point and the weights of the right and the lower ones. Without interpolation all four are
// the nearest texel.
struct Stencil {
  std::array<Vec2i, 4> positions;  // upper left, upper right, lower left, lower right
  float fx = 0, fy = 0;
};

Stencil stencil_at(const Texture& texture, Vec2 uv, int width, int height) {
  const float x = bounded(uv.x) * static_cast<float>(width), y = bounded(uv.y) * static_cast<float>(height);
  const float shift = texture.nearest ? 0 : 0.5f;
  const float x0 = std::floor(x - shift), y0 = std::floor(y - shift);
  const int step = texture.nearest ? 0 : 1;
  const int left = wrapped(static_cast<int>(x0), width, texture.wrap_u);
  const int right = wrapped(static_cast<int>(x0) + step, width, texture.wrap_u);
  const int top = wrapped(static_cast<int>(y0), height, texture.wrap_v);
  const int bottom = wrapped(static_cast<int>(y0) + step, height, texture.wrap_v);
  Stencil stencil{.positions = {Vec2i(left, top), Vec2i(right, top), Vec2i(left, bottom), Vec2i(right, bottom)}};
  if (!texture.nearest) {
    stencil.fx = x - shift - x0;
    stencil.fy = y - shift - y0;
  }
  return stencil;
}

// The level whose texels are at most as wide as the footprint.
int level_of(const image::TiledImage& image, float footprint) {
  const float texels = footprint * static_cast<float>(std::max(image.width, image.height));
  return texels < 2 ? 0 : std::min(image.levels - 1, std::ilogb(std::min(texels, 0x1p30f)));
}

Vec4 lookup_tiles(const Texture& texture, Encoding encoding, Vec2 uv, float footprint) {
  const image::TiledImage& image = *texture.tiles;
  const int level = level_of(image, footprint);
  const Stencil s = stencil_at(texture, uv, std::max(image.width >> level, 1), std::max(image.height >> level, 1));
  std::array<Vec4, 4> texels;
  if (image.type == image::PixelType::float32) {
    image::TiledImage::Texels<float> values;
    if (!image.read(level, s.positions, values)) return Vec4(1);
    for (size_t i = 0; i < texels.size(); ++i) texels[i] = to_rgba(values[i].data(), image.channels);
  } else {
    image::TiledImage::Texels<uint8_t> values;
    if (!image.read(level, s.positions, values)) return Vec4(1);
    for (size_t i = 0; i < texels.size(); ++i) texels[i] = decoded(values[i].data(), image.channels, encoding);
  }
  return glm::mix(glm::mix(texels[0], texels[1], s.fx), glm::mix(texels[2], texels[3], s.fx), s.fy);
}

}  // namespace

Vec4 lookup(const Texture& texture, Encoding encoding, Vec2 uv, float footprint) {
  if (!texture.image || texture.image->empty())
    return texture.tiles ? lookup_tiles(texture, encoding, uv, footprint) : Vec4(1);
  const image::Image& image = *texture.image;
  const float x = bounded(uv.x) * static_cast<float>(image.width), y = bounded(uv.y) * static_cast<float>(image.height);
  if (texture.nearest)
    return texel(image, encoding, wrapped(static_cast<int>(std::floor(x)), image.width, texture.wrap_u),
                 wrapped(static_cast<int>(std::floor(y)), image.height, texture.wrap_v));
  const float x0 = std::floor(x - 0.5f), y0 = std::floor(y - 0.5f);
  const float fx = x - 0.5f - x0, fy = y - 0.5f - y0;
  const int left = wrapped(static_cast<int>(x0), image.width, texture.wrap_u);
  const int right = wrapped(static_cast<int>(x0) + 1, image.width, texture.wrap_u);
  const int top = wrapped(static_cast<int>(y0), image.height, texture.wrap_v);
  const int bottom = wrapped(static_cast<int>(y0) + 1, image.height, texture.wrap_v);
  const Vec4 upper = glm::mix(texel(image, encoding, left, top), texel(image, encoding, right, top), fx);
  const Vec4 lower = glm::mix(texel(image, encoding, left, bottom), texel(image, encoding, right, bottom), fx);
  return glm::mix(upper, lower, fy);
}

void prefetch(const Texture& texture, Vec2 uv) {
  if (!texture.image || texture.image->empty()) return;
  const image::Image& image = *texture.image;
  const float shift = texture.nearest ? 0 : 0.5f;
  const int left = wrapped(static_cast<int>(std::floor(bounded(uv.x) * static_cast<float>(image.width) - shift)),
                           image.width, texture.wrap_u);
  const int row = static_cast<int>(std::floor(bounded(uv.y) * static_cast<float>(image.height) - shift));
  for (const int y : {row, row + 1}) {
    const size_t at =
        (static_cast<size_t>(wrapped(y, image.height, texture.wrap_v)) * static_cast<size_t>(image.width) +
         static_cast<size_t>(left)) *
        static_cast<size_t>(image.channels);
    if (image.type == image::PixelType::float32)
      __builtin_prefetch(&image.floats[at]);
    else
      __builtin_prefetch(&image.bytes[at]);
  }
}

Vec2 transformed(const TextureUse& use, Vec2 uv) {
  const Vec2 scaled = uv * use.scale;
  if (use.rotation == 0) return use.offset + scaled;
  const float c = std::cos(use.rotation), s = std::sin(use.rotation);
  return use.offset + Vec2(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y);
}

}  // namespace etendue
