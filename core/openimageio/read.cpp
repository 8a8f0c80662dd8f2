#include "read.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
#include <memory>

#include "color_space.h"
#include "header_check.h"
#include "message.h"

namespace etendue::openimageio {
namespace {

using image::Image;
using image::PixelType;
using image::PluginRead;
using image::PluginValues;

// The channels to read: a range that contains the colours, and their places in it.
struct Channels {
  int first = 0, end = 0;
  std::vector<int> sources = {};  // of the channels of the Image, relative to `first`
};

int find_channel(const OIIO::ImageSpec& spec, const char* name) {
  const auto found = std::ranges::find(spec.channelnames, name);
  return found == spec.channelnames.end() ? -1 : static_cast<int>(found - spec.channelnames.begin());
}

// R, G, B and A by name; otherwise the first one to four channels.
Channels choose_channels(const OIIO::ImageSpec& spec) {
  std::vector<int> chosen;
  for (const char* name : {"R", "G", "B", "A"})
    if (const int channel = find_channel(spec, name); channel >= 0) chosen.push_back(channel);
  const bool has_rgb = chosen.size() >= 3 && chosen[2] != spec.alpha_channel;
  if (!has_rgb) {
    chosen.clear();
    for (int channel = 0; channel < std::min(spec.nchannels, 4); ++channel) chosen.push_back(channel);
  }
  const auto [first, last] = std::ranges::minmax(chosen);
  Channels channels{.first = first, .end = last + 1};
  for (const int channel : chosen) channels.sources.push_back(channel - first);
  return channels;
}

bool is_integer(const OIIO::TypeDesc& type) { return !type.is_floating_point(); }

// Whether pixels are returned as bytes.
bool returns_bytes(const PluginRead& request, const OIIO::ImageSpec& spec) {
  return request.values == PluginValues::texture && is_integer(spec.format) && !is_linear(color_space(spec));
}

// All pixels of the range of channels, reordered to those of the image.
template <class Value>
bool read_pixels(OIIO::ImageInput& input, const Channels& channels, OIIO::TypeDesc type, std::vector<Value>& values) {
  const OIIO::ImageSpec& spec = input.spec();
  const size_t count = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
  const size_t stride = static_cast<size_t>(channels.end - channels.first), used = channels.sources.size();
  values.resize(count * stride);
  if (!input.read_image(0, 0, channels.first, channels.end, type, values.data())) return false;
  bool in_place = stride == used;
  for (size_t c = 0; c < used; ++c) in_place = in_place && channels.sources[c] == static_cast<int>(c);
  if (in_place) return true;
  std::vector<Value> ordered(count * used);
  for (size_t i = 0; i < count; ++i)
    for (size_t c = 0; c < used; ++c)
      ordered[i * used + c] = values[i * stride + static_cast<size_t>(channels.sources[c])];
  values = std::move(ordered);
  return true;
}

// Divides the colours by alpha.
template <class Value>
void unassociate(std::vector<Value>& values, int channels, float one) {
  const auto stride = static_cast<size_t>(channels);
  for (size_t i = 0; i + stride <= values.size(); i += stride) {
    const float alpha = static_cast<float>(values[i + stride - 1]) / one;
    for (size_t c = 0; alpha > 0 && c + 1 < stride; ++c) {
      const float value = static_cast<float>(values[i + c]) / alpha;
      values[i + c] = static_cast<Value>(one == 1 ? value : std::min(value + 0.5f, one));
    }
  }
}

// Textures have colours that are not multiplied by alpha. Readers multiply nothing (oiio:UnassociatedAlpha in the
// configuration); OpenEXR and TIFF files can hold premultiplied colours.
void unassociate(const OIIO::ImageInput& input, Image& image) {
  const OIIO::ImageSpec& spec = input.spec();
  const bool has_alpha = image.channels % 2 == 0 && spec.alpha_channel >= 0;
  const std::string_view format = input.format_name();
  if (!has_alpha || (format != "openexr" && format != "tiff")) return;
  if (spec.get_int_attribute("oiio:UnassociatedAlpha") != 0) return;
  unassociate(image.bytes, image.channels, 255);
  unassociate(image.floats, image.channels, 1);
}

Result<Image> read_opened(OIIO::ImageInput& input, const PluginRead& request) {
  const OIIO::ImageSpec spec = input.spec();
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.depth > 1 || spec.deep)
    return input_error(request.name +
                       ": the image has no pixels, or is a volume or a deep image; expected a flat image");
  if (auto size =
          request.check_size(static_cast<uint64_t>(spec.width), static_cast<uint64_t>(spec.height), request.name);
      !size)
    return size.error();
  const Channels channels = choose_channels(spec);
  Image image{.width = spec.width, .height = spec.height, .channels = static_cast<int>(channels.sources.size())};
  const bool bytes = returns_bytes(request, spec);
  image.type = bytes ? PixelType::byte8 : PixelType::float32;
  const bool complete = bytes ? read_pixels(input, channels, OIIO::TypeDesc::UINT8, image.bytes)
                              : read_pixels(input, channels, OIIO::TypeDesc::FLOAT, image.floats);
  // Some readers return success for truncated files and leave a message.
  const std::string problem = input.geterror();
  if (!complete || !problem.empty()) return input_error(request.name + ": " + cleaned(problem, request.path));
  if (request.values == PluginValues::texture)
    unassociate(input, image);
  else if (auto converted = to_linear(color_space(spec), image, request.name); !converted)
    return converted.error();
  return image;
}

}  // namespace

Result<Image> read_image(const PluginRead& request) try {
  if (auto header = check_header(request.path, request.name); !header) return header.error();
  OIIO::ImageSpec configuration;
  configuration["oiio:UnassociatedAlpha"] = 1;
  auto input = OIIO::ImageInput::open(request.path, &configuration);
  const bool opened = input != nullptr;
  const std::string problem = OIIO::geterror();
  if (!opened) input = OIIO::ImageInput::create(request.format);
  if (!input) return input_error(request.name + ": " + cleaned(problem, request.path));
  OIIO::ImageSpec spec;
  if (!opened && !input->open(request.path, spec, configuration))
    return input_error(request.name + ": " + cleaned(input->geterror(), request.path));
  return read_opened(*input, request);
} catch (const std::exception& error) {
  return input_error(request.name + ": " + cleaned(error.what(), request.path));
}

}  // namespace etendue::openimageio
