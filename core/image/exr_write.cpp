// Writing OpenEXR: float channels, ZIP compression, text attributes.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <exception>
#include <set>

#include "base/file.h"
#include "image/image.h"

namespace etendue::image {
namespace {

std::string full_name(const Layer& layer, const std::string& channel) {
  return layer.name.empty() ? channel : layer.name + "." + channel;
}

Result<void> check(const std::string& name, const LayeredImage& image) {
  if (image.width <= 0 || image.height <= 0 || image.layers.empty())
    return output_error(name + ": there are no pixels to write");
  const size_t count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  std::set<std::string> names;
  for (const Layer& layer : image.layers) {
    if (layer.channels.empty() || layer.pixels.size() != count * layer.channels.size())
      return output_error(name + ": the pixels of layer '" + layer.name + "' do not fill the picture");
    for (const std::string& channel : layer.channels)
      if (channel.empty() || !names.insert(full_name(layer, channel)).second)
        return output_error(name + ": channel '" + full_name(layer, channel) + "' is there twice or has no name");
  }
  return {};
}

Imf::Header make_header(const LayeredImage& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, text] : image.attributes) header.insert(key, Imf::StringAttribute(text));
  for (const Layer& layer : image.layers)
    for (const std::string& channel : layer.channels)
      header.channels().insert(full_name(layer, channel), Imf::Channel(Imf::FLOAT));
  return header;
}

Imf::FrameBuffer make_source(const LayeredImage& image) {
  Imf::FrameBuffer source;
  for (const Layer& layer : image.layers) {
    const size_t stride = layer.channels.size() * sizeof(float);
    for (size_t c = 0; c < layer.channels.size(); ++c) {
      char* first = reinterpret_cast<char*>(const_cast<float*>(&layer.pixels[c]));  // only read from
      source.insert(full_name(layer, layer.channels[c]),
                    Imf::Slice(Imf::FLOAT, first, stride, stride * static_cast<size_t>(image.width)));
    }
  }
  return source;
}

}  // namespace

Result<void> write_exr(const std::filesystem::path& path, const LayeredImage& image) {
  if (auto checked = check(path.string(), image); !checked) return checked;
  return write_atomically(path, [&](const std::filesystem::path& temporary) -> Result<void> {
    try {
      Imf::OutputFile file(temporary.c_str(), make_header(image));
      file.setFrameBuffer(make_source(image));
      file.writePixels(image.height);
      return {};
    } catch (const std::exception& e) {
      return output_error(path.string() + ": cannot be written as EXR: " + e.what());
    }
  });
}

}  // namespace etendue::image
