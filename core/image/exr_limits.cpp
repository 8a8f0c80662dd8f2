#include "image/exr_limits.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfHeader.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>

#include <algorithm>

namespace etendue::image {
namespace {

constexpr uint64_t kMaxValues = uint64_t{1} << 30;  // of all channels together: 4 GiB

// An upper bound of the bytes that a byte of compressed pixels gives. Deflate expands a byte to at most 1032 bytes, and
// PXR24 adds a third; PIZ and B44 compress less; DWA stores a deflated value for 64 equal pixels.
uint64_t most_bytes_per_byte(Imf::Compression compression) {
  if (compression == Imf::NO_COMPRESSION) return 1;
  const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  return dwa ? 64 * 1032 : 1032 + 1032 / 3;
}

uint64_t bytes_of_pixel(const Imf::ChannelList& channels) {
  uint64_t bytes = 0;
  for (auto c = channels.begin(); c != channels.end(); ++c) bytes += c.channel().type == Imf::HALF ? 2 : 4;
  return bytes;
}

// An error if a file of this length cannot contain the pixels of the header, or if its tiles or display window need
// much more memory than its pixels.
Result<void> check_pixel_bytes(const Imf::Header& header, Bytes bytes, const std::string& name) {
  constexpr uint64_t kTilePixels = uint64_t{1} << 20, kDisplayPixels = uint64_t{1} << 25;
  const uint64_t pixels = width_of(header.dataWindow()) * height_of(header.dataWindow());
  const uint64_t displayed = width_of(header.displayWindow()) * height_of(header.displayWindow());
  const uint64_t stored = pixels * bytes_of_pixel(header.channels());
  if (auto length = check_file_length(stored / most_bytes_per_byte(header.compression()), bytes, name); !length)
    return length;
  if (displayed > std::max(pixels, kDisplayPixels))
    return input_error(name + ": the display window of the OpenEXR file has " + std::to_string(displayed) +
                       " pixels, and only " + std::to_string(pixels) + " of them are stored; crop it to 2^25 pixels");
  if (!header.hasTileDescription()) return {};
  const auto& tile = header.tileDescription();
  if (uint64_t{tile.xSize} * tile.ySize <= std::max(pixels, kTilePixels)) return {};
  return input_error(name + ": the tiles of the OpenEXR file have " + std::to_string(tile.xSize) + " x " +
                     std::to_string(tile.ySize) + " pixels, more than the image; the file is damaged");
}

Result<void> check_part(const Imf::Header& header, Bytes bytes, const std::string& name, uint64_t& values) {
  if (header.hasType() && !Imf::isImage(header.type()))
    return input_error(name + ": deep OpenEXR images are not supported; flatten the image");
  for (const Imath::Box2i& window : {header.dataWindow(), header.displayWindow()}) {
    if (auto size = check_image_size(width_of(window), height_of(window), name); !size) return size;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
      values += width_of(window) * height_of(window);
  }
  if (values <= 2 * kMaxValues) return check_pixel_bytes(header, bytes, name);
  return input_error(name +
                     ": the OpenEXR file has more than 2^30 values in all channels; reduce the number of layers");
}

}  // namespace

Result<void> check_exr_parts(const Imf::MultiPartInputFile& file, Bytes bytes, const std::string& name) {
  uint64_t values = 0;
  for (int i = 0; i < file.parts(); ++i)
    if (auto checked = check_part(file.header(i), bytes, name, values); !checked) return checked;
  return {};
}

}  // namespace etendue::image
