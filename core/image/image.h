// Images in memory and in files
//
// Row 0 is the top of an image. Files are recognised by their content when read and by their extension when written;
// image/format.h lists the formats.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "spectrum/rgb.h"

namespace etendue::image {

enum class PixelType : uint8_t { byte8, float32 };

// An image with the pixels of its file: 8-bit values, whose encoding the file does not determine, or linear floats.
struct Image {
  int width = 0, height = 0;
  int channels = 0;  // 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
  PixelType type = PixelType::byte8;
  std::vector<uint8_t> bytes = {};  // width * height * channels values, if type is byte8
  std::vector<float> floats = {};   // the same number, if type is float32

  bool empty() const { return width == 0 || height == 0; }
  // In bytes, of the pixels.
  size_t memory() const { return bytes.size() + floats.size() * sizeof(float); }
};

struct Layer {
  std::string name;                   // "", "albedo", "depth", ...
  std::vector<std::string> channels;  // {"R", "G", "B"}, {"X", "Y", "Z"}, {"Z"}, ...
  std::vector<float> pixels;          // interleaved, channels.size() values per pixel
};

// Named layers of linear float pixels, as in an OpenEXR file. The beauty layer has the name "" and channels R, G, B.
struct LayeredImage {
  int width = 0, height = 0;
  std::vector<Layer> layers = {};
  std::map<std::string, std::string> attributes = {};  // text metadata of the file

  // The layer of this name, or null.
  const Layer* find(const std::string& name) const {
    for (const Layer& layer : layers)
      if (layer.name == name) return &layer;
    return nullptr;
  }
};

// The pixels of a layer with three channels; none if it has another number.
std::vector<Rgb> rgb_pixels(const Layer& layer);

// Decodes any format, with the first one to four channels; `name` is used in messages. Images of more than 2^28 pixels
// are an error, which is detected before memory is allocated for them. Formats other than PNG, JPEG, WebP and Radiance
// HDR need the plugin (image/plugin.h); integers of more than 8 bits are rounded to 8.
Result<Image> decode_image(std::span<const std::byte> bytes, const std::string& name);

// Reads any format as linear RGB with Rec. 709 primaries in the first layer. Integers are decoded from the colour space
// that the file declares, or from sRGB. Grey is copied to all channels, alpha is dropped. An OpenEXR file keeps its
// other layers.
Result<LayeredImage> read_linear(const std::filesystem::path& path);

// Reads an OpenEXR file with all layers and text attributes. Channels may be half, float or uint.
Result<LayeredImage> read_exr(const std::filesystem::path& path);

// The size and the text attributes of an OpenEXR file, without layers.
Result<LayeredImage> read_exr_header(const std::filesystem::path& path);

// Replaces the text attribute `name` of an OpenEXR file with one part; an empty text removes it. The pixels are copied as
// they are stored. The file is replaced atomically.
Result<void> set_exr_attribute(const std::filesystem::path& path, const std::string& name, const std::string& text);

// Writers replace an existing file atomically (base/file.h).
//
// OpenEXR: all layers as float, ZIP compression, and the attributes.
Result<void> write_exr(const std::filesystem::path& path, const LayeredImage& image);
// The same with run-length compression, for files that are read soon: less than half of the time, larger files.
Result<void> write_exr_quickly(const std::filesystem::path& path, const LayeredImage& image);
// Radiance HDR: linear RGB, three values per pixel.
Result<void> write_hdr(const std::filesystem::path& path, int width, int height, std::span<const float> rgb);
// PNG: 8-bit RGB, already display-encoded. The attributes become text chunks.
Result<void> write_png(const std::filesystem::path& path, int width, int height, std::span<const uint8_t> rgb,
                       const std::map<std::string, std::string>& attributes = {});

// PNG in memory. An Image keeps its channels; bytes are stored unchanged, floats in [0, 1] with 16 bits.
Result<std::vector<std::byte>> encode_png(int width, int height, std::span<const uint8_t> rgb);
Result<std::vector<std::byte>> encode_png(const Image& image);

}  // namespace etendue::image
