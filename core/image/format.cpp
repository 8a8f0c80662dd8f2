// The registry of image formats, and what their readers and writers share.
#include "image/format.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "image/plugin.h"

namespace etendue::image {

extern const ImageFormat kPngFormat, kJpegFormat, kWebpFormat, kHdrFormat, kExrFormat;
extern const std::array<ImageFormat, 14> kPluginFormats;

namespace {

const std::vector<const ImageFormat*>& formats() {
  static const auto all = [] {
    std::vector<const ImageFormat*> list{&kPngFormat, &kJpegFormat, &kWebpFormat, &kHdrFormat, &kExrFormat};
    for (const ImageFormat& format : kPluginFormats) list.push_back(&format);
    return list;
  }();
  return all;
}

// "A, B or C"
std::string alternatives(const std::vector<std::string_view>& names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + std::string(names[i]);
  return text;
}

std::string writable_extensions() {
  std::vector<std::string_view> extensions;
  for (const ImageFormat* format : formats())
    if (format->can_write()) extensions.push_back(format->extensions.front());
  return alternatives(extensions);
}

}  // namespace

std::span<const ImageFormat* const> image_formats() { return formats(); }

std::string readable_formats() {
  std::vector<std::string_view> labels;
  for (const ImageFormat* format : formats()) labels.push_back(format->label);
  return alternatives(labels);
}

std::vector<std::string> readable_extensions() {
  std::vector<std::string> extensions;
  for (const ImageFormat* format : formats())
    for (const std::string_view extension : format->extensions)
      if (!extension.empty()) extensions.emplace_back(extension);
  return extensions;
}

const ImageFormat* recognise_format(Bytes bytes) {
  for (const ImageFormat* format : formats())
    if (format->recognises(bytes)) return format;
  return nullptr;
}

const ImageFormat* find_writer(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension.empty()) return nullptr;
  for (const ImageFormat* format : formats())
    if (format->can_write() && std::ranges::find(format->extensions, extension) != format->extensions.end())
      return format;
  return nullptr;
}

Result<const ImageFormat*> require_writer(const std::filesystem::path& path) {
  const ImageFormat* format = find_writer(path);
  if (!format)
    return usage_error(path.string() + ": '" + path.extension().string() + "' is not a supported output format; use " +
                       writable_extensions());
  if (!format->writes_by_plugin) return format;
  if (const auto plugin = image_plugin(); !plugin) return output_error(path.string() + ": " + plugin.error().message);
  return format;
}

Result<void> check_image_size(uint64_t width, uint64_t height, const std::string& name) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width == 0 || height == 0) return input_error(name + ": the image is empty (" + size + " pixels)");
  if (width > kMaxPixels || height > kMaxPixels / width)
    return input_error(name + ": the image has " + size + " pixels according to its header; at most 2^28 can be read");
  return {};
}

Result<void> check_file_length(uint64_t required, Bytes bytes, const std::string& name) {
  if (bytes.size() >= required) return {};
  return input_error(name + ": the file has " + std::to_string(bytes.size()) +
                     " bytes, too few for the image size in its header; it is truncated or damaged");
}

Result<void> check_rgb_size(int width, int height, size_t samples, const std::string& name) {
  const size_t w = static_cast<size_t>(std::max(width, 0)), h = static_cast<size_t>(std::max(height, 0));
  if (samples > 0 && samples == w * h * 3) return {};
  return output_error(name + ": " + std::to_string(samples) + " values do not make an RGB image of " +
                      std::to_string(width) + " x " + std::to_string(height) + " pixels");
}

bool starts_with(Bytes bytes, std::string_view prefix) {
  return bytes.size() >= prefix.size() && std::memcmp(bytes.data(), prefix.data(), prefix.size()) == 0;
}

Image make_byte_image(int width, int height, int channels) {
  Image image{.width = width, .height = height, .channels = channels};
  image.bytes.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels));
  return image;
}

Error incomplete_write(const std::filesystem::path& path) {
  return output_error(path.string() + ": could not be written completely; is the disk full?");
}

}  // namespace etendue::image
