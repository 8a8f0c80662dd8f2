// Pictures in memory and in files.
//
// An Image keeps its pixels as they were stored (8-bit, or linear float); row 0 is the top. Files are recognised by
// their content when read and by their extension when written: .exr, .hdr, .png, .jpg, .webp (the last two are only
// read).
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

struct Image {
  int width = 0, height = 0, channels = 0;  // 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA
  PixelType type = PixelType::byte8;
  std::vector<uint8_t> bytes;  // width * height * channels, if type is byte8
  std::vector<float> floats;   // the same, if type is float32

  bool empty() const { return width == 0 || height == 0; }
  size_t memory() const { return bytes.size() + floats.size() * sizeof(float); }
};

// Named layers of float pixels, as an EXR file holds them. "" is the beauty layer with channels R, G, B.
struct Layer {
  std::string name;                   // "", "albedo", "depth", ...
  std::vector<std::string> channels;  // "R","G","B" or "X","Y","Z" or "Z" ...
  std::vector<float> pixels;          // interleaved, channels.size() per pixel
};

struct LayeredImage {
  int width = 0, height = 0;
  std::vector<Layer> layers;
  std::map<std::string, std::string> attributes;  // text metadata, kept in the file

  const Layer* find(const std::string& name) const;
};

// Decodes PNG, JPEG, WebP or Radiance HDR bytes. `name` is used in messages. An image of more than 2^28 pixels is an
// error, and is found to be one before memory is taken for it.
Result<Image> decode_image(std::span<const std::byte> bytes, const std::string& name);

// Any readable format as linear RGB floats in Rec. 709: sRGB files are linearised, grey is spread, alpha is dropped.
Result<LayeredImage> read_linear(const std::filesystem::path& path);

// Reads an EXR with all its layers and text attributes. Channels may be half, float or uint.
Result<LayeredImage> read_exr(const std::filesystem::path& path);

// Writers replace the file in one step (base/file.h). Float EXR, ZIP compression.
Result<void> write_exr(const std::filesystem::path& path, const LayeredImage& image);
Result<void> write_hdr(const std::filesystem::path& path, int width, int height, std::span<const float> rgb);
// 8-bit RGB, already display-encoded; the attributes become PNG text chunks.
Result<void> write_png(const std::filesystem::path& path, int width, int height, std::span<const uint8_t> rgb,
                       const std::map<std::string, std::string>& attributes = {});
// The same into memory, without text.
Result<std::vector<std::byte>> encode_png(int width, int height, std::span<const uint8_t> rgb);
// A picture with the channels it has: bytes as they are, floats between 0 and 1 in 16 bits.
Result<std::vector<std::byte>> encode_png(const Image& image);

}  // namespace etendue::image
