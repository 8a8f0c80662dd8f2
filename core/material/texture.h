// Textures: an image with wrapping, filtering and the transform of its texture coordinates.    [glTF 2.0, section 3.8]
#pragma once
#include <memory>
#include <string>

#include "base/vec.h"
#include "image/image.h"

namespace etendue {

namespace image {
class TiledImage;
}

enum class Wrap : uint8_t { repeat, mirror, clamp };

// How byte images are decoded at look-up. Float images are always linear.
enum class Encoding : uint8_t { srgb, linear };

// The pixels are in memory, or in a file whose tiles are read on demand (image/texture_memory.h), or missing.
struct Texture {
  std::shared_ptr<const image::Image> image;
  std::shared_ptr<const image::TiledImage> tiles;  // only if `image` is null
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool nearest = false;  // nearest texel instead of bilinear
  std::string name;

  friend bool operator==(const Texture&, const Texture&) = default;
};

// A use of a texture by a material. Without a texture, the value is white.
struct TextureUse {
  int texture = -1;  // index into scene::Scene::textures; -1 for none
  int uv_set = 0;    // 0 or 1
  // KHR_texture_transform: uv' = offset + R(rotation) (scale * uv).
  Vec2 offset{0}, scale{1};
  float rotation = 0;  // radians, counter-clockwise

  friend bool operator==(const TextureUse&, const TextureUse&) = default;
};

// RGBA at uv. Grey images give equal RGB, images without alpha an alpha of 1. White if the texture has no image.
// `footprint` is the width of a pixel of the rendered image in texture coordinates. It selects the mip level of tiled
// images; images in memory are not filtered. 0 selects the full resolution.
Vec4 lookup(const Texture& texture, Encoding encoding, Vec2 uv, float footprint = 0);

// Starts loading the texels that `lookup` reads at uv into the caches, if they are in memory. Texels of large textures
// are rarely there; loading those of many points together hides the latency.
void prefetch(const Texture& texture, Vec2 uv);

// The texture coordinates after the transform of the use.
Vec2 transformed(const TextureUse& use, Vec2 uv);

}  // namespace etendue
