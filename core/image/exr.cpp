// OpenEXR, through the OpenEXR library
//
// Read: flat images with one or several parts, scanlines or tiles, any compression. The result has the size of the
// display window. Its pixels outside of the data window are zero; pixels of the data window outside of the display
// window (overscan) are dropped. The channels "albedo.R", "albedo.G", ... form the layer "albedo"; a channel without a
// dot belongs to the layer "". All channels are read as float, so integers above 2^24 are rounded.
//
// Limits of what is read: exr_limits.h.
//
// Written: float channels, ZIP or run-length compression, text attributes.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>

#include "base/file.h"
#include "image/exr_attributes.h"
#include "image/exr_limits.h"
#include "image/format.h"

namespace etendue::image {
namespace {

std::string full_name(const Layer& layer, const std::string& channel) {
  return layer.name.empty() ? channel : layer.name + "." + channel;
}

// ---- Reading

// The number of threads for the blocks of an image with this number of values. 0 means that the calling thread does it.
int threads_for(size_t values) {
  constexpr size_t kParallelFrom = size_t{1} << 20;
  if (values < kParallelFrom) return 0;
  static const int count = [] {
    const int threads = static_cast<int>(std::thread::hardware_concurrency());
    Imf::setGlobalThreadCount(threads);
    return threads;
  }();
  return count;
}

class MemoryStream : public Imf::IStream {
 public:
  MemoryStream(Bytes bytes, const std::string& name) : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char target[], int size) override {
    const size_t count = static_cast<size_t>(size);
    if (position_ > bytes_.size() || count > bytes_.size() - position_)
      throw std::runtime_error("the file is truncated");
    std::memcpy(target, bytes_.data() + position_, count);
    position_ += count;
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  Bytes bytes_;
  uint64_t position_ = 0;
};

// Sort key of a channel: R, G, B, A, X, Y, Z come first in this order, then all others in the order of their names.
size_t channel_rank(const std::string& channel) {
  static const std::string order = "RGBAXYZ";
  const size_t rank = channel.size() == 1 ? order.find(channel[0]) : std::string::npos;
  return std::min(rank, order.size());
}

std::string layer_name(const std::string& full) {
  const size_t dot = full.rfind('.');
  return dot == std::string::npos ? "" : full.substr(0, dot);
}

std::string base_name(const std::string& full) { return full.substr(full.rfind('.') + 1); }

std::vector<Layer> list_layers(const Imf::ChannelList& channels) {
  std::map<std::string, Layer> layers;
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      throw std::runtime_error("channel " + std::string(c.name()) + " is subsampled; save it at full resolution");
    Layer& layer = layers[layer_name(c.name())];
    layer.name = layer_name(c.name());
    layer.channels.push_back(base_name(c.name()));
  }
  std::vector<Layer> list;
  for (auto& [name, layer] : layers) {
    std::ranges::stable_sort(layer.channels, {}, channel_rank);
    list.push_back(std::move(layer));
  }
  return list;
}

void read_lines(Imf::InputPart& part, std::vector<Layer>& layers, const Imath::Box2i& window) {
  Imf::FrameBuffer target;
  for (Layer& layer : layers) {
    const size_t channels = layer.channels.size(), stride = channels * sizeof(float);
    layer.pixels.assign(channels * width_of(window) * height_of(window), 0.0f);
    for (size_t c = 0; c < channels; ++c) {
      target.insert(full_name(layer, layer.channels[c]),
                    Imf::Slice::Make(Imf::FLOAT, &layer.pixels[c], window, stride, stride * width_of(window)));
    }
  }
  part.setFrameBuffer(target);
  part.readPixels(window.min.y, window.max.y);
}

// Converts pixels of the data window to pixels of the display window.
void crop_to_display(Layer& layer, const Imath::Box2i& data, const Imath::Box2i& display) {
  const size_t channels = layer.channels.size();
  std::vector<float> cropped(channels * width_of(display) * height_of(display), 0.0f);
  const int left = std::max(data.min.x, display.min.x), right = std::min(data.max.x, display.max.x);
  const int top = std::max(data.min.y, display.min.y), bottom = std::min(data.max.y, display.max.y);
  const auto offset = [&](const Imath::Box2i& box, int y) {
    return channels * (extent(box.min.y, y - 1) * width_of(box) + extent(box.min.x, left - 1));
  };
  for (int y = top; y <= bottom && left <= right; ++y)
    std::copy_n(layer.pixels.begin() + static_cast<std::ptrdiff_t>(offset(data, y)), channels * extent(left, right),
                cropped.begin() + static_cast<std::ptrdiff_t>(offset(display, y)));
  layer.pixels = std::move(cropped);
}

std::vector<Layer> read_part(Imf::MultiPartInputFile& file, int index) {
  const Imf::Header& header = file.header(index);
  const Imath::Box2i data = header.dataWindow();
  Imf::InputPart part(file, index);
  std::vector<Layer> layers = list_layers(header.channels());
  // The last line is read first, so that a truncated file is detected before memory is allocated for all lines.
  read_lines(part, layers, Imath::Box2i({data.min.x, data.max.y}, data.max));
  read_lines(part, layers, data);
  if (data != header.displayWindow())
    for (Layer& layer : layers) crop_to_display(layer, data, header.displayWindow());
  return layers;
}

// Attributes with a meaning in the file format.
bool is_reserved(const std::string& attribute) {
  return attribute == "name" || attribute == "type" || attribute == "view";
}

std::map<std::string, std::string> text_attributes(const Imf::Header& header) {
  std::map<std::string, std::string> texts;
  for (auto a = header.begin(); a != header.end(); ++a) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
    if (text && !is_reserved(a.name())) texts[a.name()] = text->value();
  }
  return texts;
}

// A layer of a later part whose name is taken is prefixed with the name of the part.
void add_layers(std::vector<Layer> layers, const Imf::Header& header, LayeredImage& image) {
  for (Layer& layer : layers) {
    if (image.find(layer.name)) {
      const std::string part = header.hasName() ? header.name() : "part";
      layer.name = layer.name.empty() ? part : part + "." + layer.name;
    }
    image.layers.push_back(std::move(layer));
  }
}

LayeredImage without_layers(const Imf::MultiPartInputFile& file) {
  LayeredImage image;
  const Imath::Box2i display = file.header(0).displayWindow();
  image.width = static_cast<int>(width_of(display));
  image.height = static_cast<int>(height_of(display));
  image.attributes = text_attributes(file.header(0));
  return image;
}

enum class Content { header, everything };

Result<LayeredImage> decode(Imf::MultiPartInputFile& file, Bytes bytes, const std::string& name, Content content) {
  if (auto checked = check_exr_parts(file, bytes, name); !checked) return checked.error();
  LayeredImage image = without_layers(file);
  if (content == Content::header) return image;
  for (int i = 0; i < file.parts(); ++i) add_layers(read_part(file, i), file.header(i), image);
  return image;
}

// ---- Writing

Result<void> check_layers(const std::string& name, const LayeredImage& image) {
  if (image.width <= 0 || image.height <= 0 || image.layers.empty()) return output_error(name + ": the image is empty");
  const size_t count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  std::set<std::string> names;
  for (const Layer& layer : image.layers) {
    if (layer.channels.empty() || layer.pixels.size() != count * layer.channels.size())
      return output_error(name + ": layer '" + layer.name + "' has the wrong number of pixels");
    for (const std::string& channel : layer.channels)
      if (channel.empty() || !names.insert(full_name(layer, channel)).second)
        return output_error(name + ": channel '" + full_name(layer, channel) + "' occurs twice or has no name");
  }
  return {};
}

Imf::Header make_header(const LayeredImage& image, Imf::Compression compression) {
  Imf::Header header(image.width, image.height);
  header.compression() = compression;
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

// A file whose errors are recorded, because the destructor of Imf::OutputFile, which writes the last bytes, ignores them.
class FileStream : public Imf::OStream {
 public:
  explicit FileStream(const std::filesystem::path& path)
      : Imf::OStream(path.c_str()), file_(std::fopen(path.c_str(), "wb"), std::fclose) {}

  void write(const char bytes[], int size) override {
    const auto count = static_cast<size_t>(size);
    complete_ = complete_ && file_ && std::fwrite(bytes, 1, count, file_.get()) == count;
    if (!complete_) throw std::runtime_error("the file is incomplete");
  }
  uint64_t tellp() override { return file_ ? static_cast<uint64_t>(std::ftell(file_.get())) : 0; }
  void seekp(uint64_t position) override {
    complete_ = complete_ && file_ && std::fseek(file_.get(), static_cast<long>(position), SEEK_SET) == 0;
  }

  // Returns whether all bytes were written, also now.
  bool close() {
    complete_ = file_ && std::fclose(file_.release()) == 0 && complete_;
    return complete_;
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  bool complete_ = true;
};

void write_pixels(FileStream& stream, const LayeredImage& image, Imf::Compression compression) {
  size_t values = 0;
  for (const Layer& layer : image.layers) values += layer.pixels.size();
  Imf::OutputFile file(stream, make_header(image, compression), threads_for(values));
  file.setFrameBuffer(make_source(image));
  file.writePixels(image.height);
}

bool is_exr(Bytes bytes) { return starts_with(bytes, "\x76\x2f\x31\x01"); }

Result<LayeredImage> decode_content(Bytes bytes, const std::string& name, Content content) {
  if (!is_exr(bytes)) return input_error(name + ": this is not an OpenEXR file");
  if (auto checked = check_exr_attributes(bytes, name); !checked) return checked.error();
  try {
    MemoryStream stream(bytes, name);
    const int threads = content == Content::header ? 0 : threads_for(bytes.size() / sizeof(float));
    Imf::MultiPartInputFile file(stream, threads, false);
    return decode(file, bytes, name, content);
  } catch (const std::exception& e) {
    return input_error(name + ": damaged or unsupported OpenEXR: " + e.what());
  }
}

Result<LayeredImage> decode_bytes(Bytes bytes, const std::string& name) {
  return decode_content(bytes, name, Content::everything);
}

}  // namespace

Result<LayeredImage> read_exr(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  return decode_bytes(*bytes, path.string());
}

Result<LayeredImage> read_exr_header(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  return decode_content(*bytes, path.string(), Content::header);
}

namespace {

// Without this attribute. (Imf::Header::erase does not free it.)
Imf::Header header_without(const std::string& name, const Imf::Header& header) {
  Imf::Header rest;
  for (auto a = header.begin(); a != header.end(); ++a)
    if (a.name() != name) rest.insert(a.name(), a.attribute());
  return rest;
}

Result<void> write_exr_file(const std::filesystem::path& path, const LayeredImage& image,
                            Imf::Compression compression) {
  if (auto checked = check_layers(path.string(), image); !checked) return checked;
  return write_atomically(path, [&](const std::filesystem::path& temporary) -> Result<void> {
    FileStream stream(temporary);
    std::string problem;
    try {
      write_pixels(stream, image, compression);
    } catch (const std::exception& e) {
      problem = e.what();
    }
    if (!stream.close()) return incomplete_write(path);
    if (!problem.empty()) return output_error(path.string() + ": cannot be written as OpenEXR: " + problem);
    return {};
  });
}

}  // namespace

Result<void> write_exr(const std::filesystem::path& path, const LayeredImage& image) {
  return write_exr_file(path, image, Imf::ZIP_COMPRESSION);
}

Result<void> write_exr_quickly(const std::filesystem::path& path, const LayeredImage& image) {
  return write_exr_file(path, image, Imf::RLE_COMPRESSION);
}

Result<void> set_exr_attribute(const std::filesystem::path& path, const std::string& name, const std::string& text) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  if (const auto readable = decode_content(*bytes, path.string(), Content::header); !readable) return readable.error();
  return write_atomically(path, [&](const std::filesystem::path& temporary) -> Result<void> {
    FileStream out(temporary);
    std::string problem;
    try {
      MemoryStream in(*bytes, path.string());
      if (Imf::MultiPartInputFile(in, 0, false).parts() > 1) throw std::runtime_error("the file has several parts");
      in.seekg(0);
      Imf::InputFile source(in, 0);
      Imf::Header header = header_without(name, source.header());
      if (!text.empty()) header.insert(name, Imf::StringAttribute(text));
      Imf::OutputFile(out, header, 0).copyPixels(source);
    } catch (const std::exception& e) {
      problem = e.what();
    }
    if (!out.close()) return incomplete_write(path);
    if (!problem.empty()) return output_error(path.string() + ": the text cannot be stored: " + problem);
    return {};
  });
}

extern const ImageFormat kExrFormat{
    .name = "exr",
    .label = "OpenEXR",
    .extensions = {".exr"},
    .doc = "Read and written: layers of linear values with text attributes.",
    .recognises = is_exr,
    .decode_layers = decode_bytes,
    .write_layers = write_exr,
};

}  // namespace etendue::image
