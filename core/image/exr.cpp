// Reading OpenEXR: flat pictures of one or several parts, scanlines or tiles, any compression.
//
// The result is the display window. Pixels of it outside the data window are zero; what lies in the data window beyond
// it (overscan) is cut off. Channels "albedo.R", "albedo.G", ... form the layer "albedo"; a channel without a dot
// belongs to the layer "". Integers above 2^24 are rounded, as every channel is read as float.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "base/file.h"
#include "image/codecs.h"

namespace etendue::image {
namespace {

constexpr uint64_t kMaxValues = uint64_t{1} << 30;  // in all channels together: 4 GiB

class MemoryStream : public Imf::IStream {
 public:
  MemoryStream(Bytes bytes, const std::string& name) : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char target[], int size) override {
    const size_t wanted = static_cast<size_t>(size);
    if (at_ > bytes_.size() || wanted > bytes_.size() - at_) throw std::runtime_error("the file is cut off");
    std::memcpy(target, bytes_.data() + at_, wanted);
    at_ += wanted;
    return at_ < bytes_.size();
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t position) override { at_ = position; }

 private:
  Bytes bytes_;
  uint64_t at_ = 0;
};

uint64_t extent(int min, int max) { return max < min ? 0 : static_cast<uint64_t>(int64_t{max} - min + 1); }
uint64_t width_of(const Imath::Box2i& box) { return extent(box.min.x, box.max.x); }
uint64_t height_of(const Imath::Box2i& box) { return extent(box.min.y, box.max.y); }

// R, G, B, A and X, Y, Z stand in this order, whatever the file's; other channels follow by name.
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
      const std::string full = layer.name.empty() ? layer.channels[c] : layer.name + "." + layer.channels[c];
      target.insert(full, Imf::Slice::Make(Imf::FLOAT, &layer.pixels[c], window, stride, stride * width_of(window)));
    }
  }
  part.setFrameBuffer(target);
  part.readPixels(window.min.y, window.max.y);
}

// The pixels that both windows share, in a picture as large as the display window.
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
  // A file that is cut off lacks its last line: found out before memory is taken for all of them.
  read_lines(part, layers, Imath::Box2i({data.min.x, data.max.y}, data.max));
  read_lines(part, layers, data);
  if (data != header.displayWindow())
    for (Layer& layer : layers) crop_to_display(layer, data, header.displayWindow());
  return layers;
}

// What the format keeps for itself in the header of a part.
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

Result<void> check_part(const Imf::Header& header, const std::string& name, uint64_t& values) {
  if (header.hasType() && !Imf::isImage(header.type()))
    return input_error(name + ": deep EXR cannot be read; flatten it");
  for (const Imath::Box2i& window : {header.dataWindow(), header.displayWindow()}) {
    if (auto size = check_size(width_of(window), height_of(window), name); !size) return size;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
      values += width_of(window) * height_of(window);
  }
  if (values <= 2 * kMaxValues) return {};
  return input_error(name + ": the EXR holds more than 2^30 values in its channels; give fewer layers");
}

// Later parts keep their own name where a layer of that name is there already.
void add_layers(std::vector<Layer> layers, const Imf::Header& header, LayeredImage& image) {
  for (Layer& layer : layers) {
    if (image.find(layer.name)) {
      const std::string part = header.hasName() ? header.name() : "part";
      layer.name = layer.name.empty() ? part : part + "." + layer.name;
    }
    image.layers.push_back(std::move(layer));
  }
}

Result<LayeredImage> decode(Imf::MultiPartInputFile& file, const std::string& name) {
  uint64_t values = 0;
  for (int i = 0; i < file.parts(); ++i)
    if (auto checked = check_part(file.header(i), name, values); !checked) return checked.error();
  LayeredImage image;
  const Imath::Box2i display = file.header(0).displayWindow();
  image.width = static_cast<int>(width_of(display)), image.height = static_cast<int>(height_of(display));
  image.attributes = text_attributes(file.header(0));
  for (int i = 0; i < file.parts(); ++i) add_layers(read_part(file, i), file.header(i), image);
  return image;
}

}  // namespace

bool is_exr(Bytes bytes) { return starts_with(bytes, "\x76\x2f\x31\x01"); }

Result<LayeredImage> decode_exr(Bytes bytes, const std::string& name) {
  if (!is_exr(bytes)) return input_error(name + ": this is no OpenEXR file");
  try {
    MemoryStream stream(bytes, name);
    Imf::MultiPartInputFile file(stream, 0, false);
    return decode(file, name);
  } catch (const std::exception& e) {
    return input_error(name + ": damaged or unsupported EXR: " + e.what());
  }
}

Result<LayeredImage> read_exr(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  return decode_exr(*bytes, path.string());
}

}  // namespace etendue::image
