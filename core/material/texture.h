// Textures: an image, how it is wrapped and filtered, and how texture coordinates reach it.   glTF 2.0, section 3.8
#pragma once
#include <memory>
#include <string>

#include "base/vec.h"
#include "image/image.h"

namespace etendue {

enum class Wrap : uint8_t { repeat, mirror, clamp };

// sRGB pictures are decoded when looked up. Float pictures are linear.
enum class Encoding : uint8_t { srgb, linear };

struct Texture {
  std::shared_ptr<const image::Image> image;
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool nearest = false;  // nearest texel instead of bilinear
  std::string name;

  friend bool operator==(const Texture&, const Texture&) = default;
};

// A use of a texture by a material. No texture reads as white.
struct TextureUse {
  int texture = -1;  // index into scene::Scene::textures
  int uv_set = 0;    // 0 or 1
  // KHR_texture_transform: uv' = offset + R(rotation) * (scale * uv). Identity unless the file says otherwise.
  Vec2 offset{0}, scale{1};
  float rotation = 0;  // radians, counter-clockwise

  friend bool operator==(const TextureUse&, const TextureUse&) = default;
};

// RGBA at uv; grey images spread to RGB, a missing alpha is one.
Vec4 lookup(const Texture& texture, Encoding encoding, Vec2 uv);

Vec2 transformed(const TextureUse& use, Vec2 uv);

}  // namespace etendue
