#include "material/texture.h"

#include <array>

#include "spectrum/rgb.h"

namespace etendue {
namespace {

// sRGB bytes as linear values.
const std::array<float, 256>& srgb_table() {
  static const auto table = [] {
    std::array<float, 256> t{};
    for (size_t i = 0; i < t.size(); ++i) t[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
    return t;
  }();
  return table;
}

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

Vec4 texel(const image::Image& image, Encoding encoding, int x, int y) {
  const size_t at = (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)) *
                    static_cast<size_t>(image.channels);
  if (image.type == image::PixelType::float32) return to_rgba(&image.floats[at], image.channels);
  std::array<float, 4> v{};
  const int colors = image.channels < 3 ? 1 : 3;
  for (int c = 0; c < image.channels; ++c) {
    const uint8_t byte = image.bytes[at + static_cast<size_t>(c)];
    v[static_cast<size_t>(c)] =
        encoding == Encoding::srgb && c < colors ? srgb_table()[byte] : static_cast<float>(byte) * (1 / 255.0f);
  }
  return to_rgba(v.data(), image.channels);
}

// Replaces coordinates whose texel index would overflow by 0.
float bounded(float x) { return std::abs(x) < 1e6f ? x : 0; }

}  // namespace

Vec4 lookup(const Texture& texture, Encoding encoding, Vec2 uv) {
  if (!texture.image || texture.image->empty()) return Vec4(1);
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

Vec2 transformed(const TextureUse& use, Vec2 uv) {
  const Vec2 scaled = uv * use.scale;
  if (use.rotation == 0) return use.offset + scaled;
  const float c = std::cos(use.rotation), s = std::sin(use.rotation);
  return use.offset + Vec2(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y);
}

}  // namespace etendue
