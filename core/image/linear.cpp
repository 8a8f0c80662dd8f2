// Reading any format as linear RGB, for metrics, environment maps and comparisons.
#include <algorithm>
#include <array>

#include "base/file.h"
#include "image/format.h"

namespace etendue::image {
namespace {

const std::vector<std::string> kRgb{"R", "G", "B"};

size_t channel_index(const Layer& layer, std::string_view channel) {
  return static_cast<size_t>(std::ranges::find(layer.channels, channel) - layer.channels.begin());
}

bool has_channel(const Layer& layer, std::string_view channel) {
  return channel_index(layer, channel) < layer.channels.size();
}

bool has_rgb(const Layer& layer) {
  return has_channel(layer, "R") && has_channel(layer, "G") && has_channel(layer, "B");
}

// The beauty layer: the one without a name, else "*.Combined" as written by Blender, else the first with R, G and B.
// Null if there is none.
Layer* find_beauty(LayeredImage& image) {
  Layer* best = nullptr;
  for (Layer& layer : image.layers) {
    if (layer.name.empty() && (has_rgb(layer) || has_channel(layer, "Y"))) return &layer;
    const bool combined = layer.name.ends_with("Combined");
    if (has_rgb(layer) && (combined || !best)) best = &layer;
  }
  return best;
}

std::array<size_t, 3> rgb_indices(const Layer& layer) {
  if (has_rgb(layer)) return {channel_index(layer, "R"), channel_index(layer, "G"), channel_index(layer, "B")};
  const size_t grey = channel_index(layer, "Y");
  return {grey, grey, grey};
}

// R, G and B of a layer, or the luminance Y copied to all three.
Layer as_rgb(const Layer& layer) {
  const auto source = rgb_indices(layer);
  const size_t stride = layer.channels.size(), count = layer.pixels.size() / stride;
  Layer rgb{"", kRgb, std::vector<float>(count * 3)};
  for (size_t i = 0; i < count; ++i)
    for (size_t c = 0; c < 3; ++c) rgb.pixels[i * 3 + c] = layer.pixels[i * stride + source[c]];
  return rgb;
}

// Moves the beauty layer to the front and reduces it to RGB.
Result<LayeredImage> with_rgb_first(Result<LayeredImage> image, const std::string& name) {
  if (!image) return image;
  Layer* beauty = find_beauty(*image);
  if (!beauty) return input_error(name + ": no layer has the channels R, G and B, or the luminance Y");
  *beauty = as_rgb(*beauty);
  std::iter_swap(beauty, image->layers.begin());
  return image;
}

std::array<float, 256> make_srgb_table() {
  std::array<float, 256> table;
  for (size_t i = 0; i < table.size(); ++i) table[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
  return table;
}

// The RGB values, decoded from sRGB if the image has 8 bits.
Layer linearise(const Image& image) {
  static const std::array<float, 256> to_linear = make_srgb_table();
  const size_t stride = static_cast<size_t>(image.channels), step = image.channels >= 3 ? 1 : 0;
  const size_t count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  const bool encoded = image.type == PixelType::byte8;
  Layer rgb{"", kRgb, std::vector<float>(count * 3)};
  for (size_t i = 0; i < count; ++i)
    for (size_t c = 0; c < 3; ++c) {
      const size_t at = i * stride + c * step;
      rgb.pixels[i * 3 + c] = encoded ? to_linear[image.bytes[at]] : image.floats[at];
    }
  return rgb;
}

}  // namespace

Result<LayeredImage> read_linear(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  const std::string name = path.string();
  const ImageFormat* format = recognise_format(*bytes);
  if (format && format->decode_layers) return with_rgb_first(format->decode_layers(*bytes, name), name);
  const auto image = format && format->read_linear ? format->read_linear(path, *format) : decode_image(*bytes, name);
  if (!image) return image.error();
  LayeredImage linear{.width = image->width, .height = image->height};
  linear.layers.push_back(linearise(*image));
  return linear;
}

std::vector<Rgb> rgb_pixels(const Layer& layer) {
  std::vector<Rgb> pixels;
  if (layer.channels.size() != 3) return pixels;
  pixels.reserve(layer.pixels.size() / 3);
  for (size_t i = 0; i + 2 < layer.pixels.size(); i += 3)
    pixels.emplace_back(layer.pixels[i], layer.pixels[i + 1], layer.pixels[i + 2]);
  return pixels;
}

}  // namespace etendue::image
