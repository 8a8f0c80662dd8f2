// An image whose pixels stay in a file and are read in tiles on demand.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/result.h"
#include "base/vec.h"
#include "image/image.h"

namespace etendue::image {

// Level 0 is the image itself; each further level has half the width and height, at least 1, and holds the means of
// 2 x 2 pixels.
class TiledImage {
 public:
  virtual ~TiledImage() = default;

  int width = 0, height = 0;  // of level 0
  int channels = 0;           // as in Image
  PixelType type = PixelType::byte8;
  int levels = 1;
  uint64_t hash = 0;  // of the encoded image

  static constexpr int kMaxChannels = 4;
  // Four pixels, of which the first `channels` values are set.
  template <class Value>
  using Texels = std::array<std::array<Value, kMaxChannels>, 4>;

  // Reads the pixels at four positions inside of a level; the overload of the image's type must be called. Returns
  // false if the file cannot be read. May be called by several threads.
  virtual bool read(int level, const std::array<Vec2i, 4>& positions, Texels<uint8_t>& texels) const = 0;
  virtual bool read(int level, const std::array<Vec2i, 4>& positions, Texels<float>& texels) const = 0;

  // All pixels of level 0.
  virtual Result<Image> pixels() const = 0;
};

}  // namespace etendue::image
