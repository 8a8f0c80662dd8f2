// Writes tiled, mip-mapped TIFF files. Tiles are not compressed: a tile is read in a fifth of the time of a compressed
// one.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "message.h"
#include "spectrum/rgb.h"
#include "tiles.h"

namespace etendue::openimageio {
namespace {

using image::Image;
using image::PixelType;

constexpr int kTileSize = 64;  // pixels

// sRGB bytes as linear values, and linear values in [0, 1] in steps of 2^-16 as sRGB bytes.
struct SrgbTables {
  std::array<float, 256> linear;
  std::array<uint8_t, 65537> encoded;

  SrgbTables() {
    for (size_t i = 0; i < linear.size(); ++i) linear[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
    for (size_t i = 0; i < encoded.size(); ++i)
      encoded[i] = static_cast<uint8_t>(std::lround(linear_to_srgb(static_cast<float>(i) * 0x1p-16f) * 255.0f));
  }
};

uint8_t mean(const std::array<uint8_t, 4>& v, bool srgb) {
  if (!srgb) return static_cast<uint8_t>((v[0] + v[1] + v[2] + v[3] + 2) / 4);
  static const SrgbTables tables;
  const float sum = tables.linear[v[0]] + tables.linear[v[1]] + tables.linear[v[2]] + tables.linear[v[3]];
  return tables.encoded[static_cast<size_t>(sum * 0x1p14f + 0.5f)];
}

float mean(const std::array<float, 4>& v, bool) { return (v[0] + v[1] + v[2] + v[3]) / 4; }

// The image of half the width and height. The last column or row of an odd size is dropped.
template <class Value>
std::vector<Value> halved(const std::vector<Value>& source, int width, int height, int channels, bool srgb) {
  const auto w = static_cast<size_t>(width), h = static_cast<size_t>(height), n = static_cast<size_t>(channels);
  const size_t half_width = std::max<size_t>(w / 2, 1), half_height = std::max<size_t>(h / 2, 1);
  const size_t colors = n >= 3 ? 3 : 1;
  std::vector<Value> result(half_width * half_height * n);
  for (size_t y = 0; y < half_height; ++y) {
    const size_t upper = 2 * y * w, lower = std::min(2 * y + 1, h - 1) * w;
    for (size_t x = 0; x < half_width; ++x) {
      const size_t left = 2 * x, right = std::min(2 * x + 1, w - 1);
      for (size_t c = 0; c < n; ++c)
        result[(y * half_width + x) * n + c] =
            mean(std::array<Value, 4>{source[(upper + left) * n + c], source[(upper + right) * n + c],
                                      source[(lower + left) * n + c], source[(lower + right) * n + c]},
                 srgb && c < colors);
    }
  }
  return result;
}

template <class Value>
bool write_levels(OIIO::ImageOutput& output, OIIO::ImageSpec spec, const std::string& file,
                  const std::vector<Value>& pixels, bool srgb) {
  if (!output.open(file, spec) || !output.write_image(spec.format, pixels.data())) return false;
  std::vector<Value> level;
  while (spec.width > 1 || spec.height > 1) {
    level = halved(level.empty() ? pixels : level, spec.width, spec.height, spec.nchannels, srgb);
    spec.width = spec.full_width = std::max(spec.width / 2, 1);
    spec.height = spec.full_height = std::max(spec.height / 2, 1);
    // TIFF files store levels as images; "textureformat" marks them as levels.
    if (!output.open(file, spec, OIIO::ImageOutput::AppendSubimage)) return false;
    if (!output.write_image(spec.format, level.data())) return false;
  }
  return output.close();
}

}  // namespace

Result<void> write_tiles(const Image& image, bool srgb, const std::string& file) try {
  const bool bytes = image.type == PixelType::byte8;
  OIIO::ImageSpec spec(image.width, image.height, image.channels,
                       bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
  spec.tile_width = spec.tile_height = kTileSize;
  spec.attribute("compression", "none");
  spec.attribute("textureformat", "Plain Texture");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (spec.image_bytes() > (uint64_t{1} << 31)) spec.attribute("tiff:bigtiff", 1);
  const auto output = OIIO::ImageOutput::create("tiff");
  if (!output) return output_error(cleaned(OIIO::geterror(), file));
  const bool written = bytes ? write_levels(*output, spec, file, image.bytes, srgb)
                             : write_levels(*output, spec, file, image.floats, srgb);
  if (written) return {};
  return output_error(file + ": cannot be written: " + cleaned(output->geterror(), file));
} catch (const std::exception& error) {
  return output_error(file + ": cannot be written: " + cleaned(error.what(), file));
}

}  // namespace etendue::openimageio
