// OpenEXR: layers of float channels, and text attributes.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "base/file.h"
#include "image/codecs.h"

namespace etendue::image {
namespace {

// "albedo.R" is channel R of layer albedo; a plain name is a channel of the beauty layer.
std::pair<std::string, std::string> split_name(const std::string& full) {
  const size_t dot = full.rfind('.');
  return dot == std::string::npos ? std::pair{std::string(), full} : std::pair{full.substr(0, dot), full.substr(dot + 1)};
}

// The order in which people expect channels; anything else follows as the file has it.
int rank(const std::string& channel) {
  static const std::string kOrder = "RGBAXYZV";
  const size_t at = channel.size() == 1 ? kOrder.find(channel) : std::string::npos;
  return at == std::string::npos ? static_cast<int>(kOrder.size()) : static_cast<int>(at);
}

std::vector<Layer> layers_of(const Imf::ChannelList& channels) {
  std::vector<Layer> layers;
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    const auto [layer_name, channel] = split_name(c.name());
    auto layer = std::find_if(layers.begin(), layers.end(), [&, n = layer_name](const Layer& l) { return l.name == n; });
    if (layer == layers.end()) layer = layers.insert(layers.end(), Layer{layer_name, {}, {}});
    layer->channels.push_back(channel);
  }
  for (auto& layer : layers)
    std::stable_sort(layer.channels.begin(), layer.channels.end(), [](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return layers;
}

std::string full_name(const Layer& layer, size_t channel) {
  return layer.name.empty() ? layer.channels[channel] : layer.name + "." + layer.channels[channel];
}

// A slice of every channel of every layer; `origin` is the pixel that the arrays start with.
Imf::FrameBuffer slices(std::vector<Layer>& layers, int width, Imath::V2i origin) {
  Imf::FrameBuffer buffer;
  for (auto& layer : layers) {
    const size_t n = layer.channels.size(), stride = n * sizeof(float);
    const auto back = static_cast<std::ptrdiff_t>(origin.x + static_cast<int64_t>(origin.y) * width) * static_cast<std::ptrdiff_t>(stride);
    for (size_t c = 0; c < n; ++c)
      buffer.insert(full_name(layer, c), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(layer.pixels.data() + c) - back, stride,
                                                    stride * static_cast<size_t>(width)));
  }
  return buffer;
}

}  // namespace

Result<LayeredImage> read_exr(const std::filesystem::path& path) {
  // The library's own messages name neither what is missing nor the folder.
  if (auto bytes = read_file(path); !bytes)
    return bytes.error();
  else if (!is_exr(*bytes))
    return input_error(path.string() + ": this is no OpenEXR file; give an .exr");
  try {
    Imf::InputFile file(path.c_str());
    const Imath::Box2i window = file.header().dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1, height = int64_t{window.max.y} - window.min.y + 1;
    if (!reasonable(width, height)) return bad_picture(path.string(), "EXR of an absurd size");
    LayeredImage image;
    image.width = static_cast<int>(width), image.height = static_cast<int>(height);
    image.layers = layers_of(file.header().channels());
    for (auto& layer : image.layers) layer.pixels.resize(static_cast<size_t>(width * height) * layer.channels.size());
    file.setFrameBuffer(slices(image.layers, image.width, window.min));
    file.readPixels(window.min.y, window.max.y);
    for (auto a = file.header().begin(); a != file.header().end(); ++a)
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) image.attributes[a.name()] = text->value();
    return image;
  } catch (const std::exception& error) {
    return bad_picture(path.string(), std::string("EXR: ") + error.what());
  }
}

Result<void> write_exr(const std::filesystem::path& path, const LayeredImage& image) {
  return write_atomically(path, [&](const std::filesystem::path& temporary) -> Result<void> {
    try {
      Imf::Header header(image.width, image.height);
      header.compression() = Imf::ZIP_COMPRESSION;
      std::vector<Layer> layers = image.layers;
      for (const auto& layer : layers)
        for (size_t c = 0; c < layer.channels.size(); ++c) header.channels().insert(full_name(layer, c), Imf::Channel(Imf::FLOAT));
      for (const auto& [name, text] : image.attributes) header.insert(name, Imf::StringAttribute(text));
      Imf::OutputFile file(temporary.c_str(), header);
      file.setFrameBuffer(slices(layers, image.width, Imath::V2i(0, 0)));
      file.writePixels(image.height);
      return {};
    } catch (const std::exception& error) {
      return output_error(path.string() + ": cannot be written: " + error.what());
    }
  });
}

}  // namespace etendue::image
