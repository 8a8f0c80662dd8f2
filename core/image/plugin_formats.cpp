// The formats that are read and written through OpenImageIO (image/plugin.h).
#include <array>
#include <cstring>

#include "image/format.h"
#include "image/plugin_io.h"

namespace etendue::image {
namespace {

uint16_t little_endian16(Bytes bytes, size_t at) {
  return static_cast<uint16_t>(std::to_integer<unsigned>(bytes[at]) | std::to_integer<unsigned>(bytes[at + 1]) << 8);
}

bool has_at(Bytes bytes, size_t position, std::string_view text) {
  return bytes.size() >= position && starts_with(bytes.subspan(position), text);
}

bool is_tiff(Bytes bytes) {
  using namespace std::string_view_literals;
  for (const std::string_view start : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv})
    if (starts_with(bytes, start)) return true;
  return false;
}

bool is_dds(Bytes bytes) { return starts_with(bytes, "DDS "); }
bool is_psd(Bytes bytes) { return starts_with(bytes, "8BPS"); }
bool is_bmp(Bytes bytes) { return starts_with(bytes, "BM") && bytes.size() >= 26; }
bool is_gif(Bytes bytes) { return starts_with(bytes, "GIF8"); }
bool is_dpx(Bytes bytes) { return starts_with(bytes, "SDPX") || starts_with(bytes, "XPDS"); }
bool is_cineon(Bytes bytes) { return starts_with(bytes, "\x80\x2a\x5f\xd7") || starts_with(bytes, "\xd7\x5f\x2a\x80"); }
bool is_sgi(Bytes bytes) { return starts_with(bytes, "\x01\xda"); }

bool is_jpeg2000(Bytes bytes) { return has_at(bytes, 4, "jP  ") || starts_with(bytes, "\xff\x4f\xff\x51"); }

bool is_heif(Bytes bytes) {
  if (!has_at(bytes, 4, "ftyp")) return false;
  for (const std::string_view brand : {"heic", "heix", "heim", "heis", "hevc", "mif1", "msf1", "avif"})
    if (has_at(bytes, 8, brand)) return true;
  return false;
}

bool is_netpbm(Bytes bytes, std::string_view kinds) {
  return bytes.size() > 2 && starts_with(bytes, "P") &&
         kinds.find(static_cast<char>(bytes[1])) != std::string_view::npos &&
         std::string_view(" \t\r\n#").find(static_cast<char>(bytes[2])) != std::string_view::npos;
}
bool is_pnm(Bytes bytes) { return is_netpbm(bytes, "123456"); }
bool is_pfm(Bytes bytes) { return is_netpbm(bytes, "fF"); }

bool is_raw(Bytes bytes) {
  using namespace std::string_view_literals;
  for (const std::string_view start :
       {"FUJIFILMCCD-RAW"sv, "IIU\0"sv, "IIRO"sv, "IIRS"sv, "MMOR"sv, "FOVb"sv, "\0MRM"sv})
    if (starts_with(bytes, start)) return true;
  return has_at(bytes, 6, "HEAPCCDR") || has_at(bytes, 4, "ftypcrx ");
}

// Targa files begin without a signature: their header is checked for values that the format allows.
bool is_tga(Bytes bytes) {
  if (bytes.size() < 18) return false;
  const auto at = [&](size_t i) { return std::to_integer<unsigned>(bytes[i]); };
  const unsigned palette = at(1), kind = at(2) & ~8u, depth = at(16);
  const bool known_kind = (kind == 1 && palette == 1) || kind == 2 || kind == 3;
  const bool known_depth = depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32;
  return palette <= 1 && at(2) <= 11 && known_kind && known_depth && little_endian16(bytes, 12) > 0 &&
         little_endian16(bytes, 14) > 0 && (at(17) & 0xc0) == 0;
}

ImageFormat plugin_format(const ImageFormat& description) {
  ImageFormat format = description;
  format.decode = decode_by_plugin;
  format.read_linear = read_linear_by_plugin;
  format.reads_by_plugin = true;
  format.writes_by_plugin = format.can_write();
  return format;
}

}  // namespace

// Targa is the last, because its recognition is the weakest.
extern const std::array<ImageFormat, 14> kPluginFormats{
    plugin_format(
        {.name = "tiff",
         .label = "TIFF",
         .extensions = {".tif", ".tiff", ".tx"},
         .doc = "Read: all bit depths, also tiled and mip-mapped files. Written: linear RGB as 32-bit floats.",
         .recognises = is_tiff,
         .write_linear = write_linear_by_plugin}),
    plugin_format({.name = "pfm",
                   .label = "PFM",
                   .extensions = {".pfm"},
                   .doc = "Read: linear values as 32-bit floats.",
                   .recognises = is_pfm}),
    plugin_format({.name = "pnm",
                   .label = "PNM",
                   .extensions = {".ppm", ".pgm", ".pbm"},
                   .doc = "Read: 1 to 16 bits. Written: display-encoded 8-bit RGB.",
                   .recognises = is_pnm,
                   .write_display = write_display_by_plugin}),
    plugin_format({.name = "bmp",
                   .label = "BMP",
                   .extensions = {".bmp"},
                   .doc = "Read: with and without palette. Written: display-encoded 8-bit RGB.",
                   .recognises = is_bmp,
                   .write_display = write_display_by_plugin}),
    plugin_format({.name = "dpx",
                   .label = "DPX",
                   .extensions = {".dpx"},
                   .doc = "Read: 8 to 16 bits; logarithmic values become linear. Written: display-encoded 8-bit RGB.",
                   .recognises = is_dpx,
                   .write_display = write_display_by_plugin}),
    plugin_format({.name = "jpeg2000",
                   .label = "JPEG 2000",
                   .extensions = {".jp2", ".j2k", ".j2c"},
                   .doc = "Read: 8 to 16 bits. Written: display-encoded 8-bit RGB.",
                   .recognises = is_jpeg2000,
                   .write_display = write_display_by_plugin}),
    plugin_format({.name = "heif",
                   .label = "HEIC",
                   .extensions = {".heic", ".heif", ".avif"},
                   .doc = "Read: the primary image, with alpha. Written: display-encoded 8-bit RGB.",
                   .recognises = is_heif,
                   .write_display = write_display_by_plugin}),
    plugin_format({.name = "sgi",
                   .label = "SGI",
                   .extensions = {".sgi", ".rgb", ".rgba"},
                   .doc = "Read: 8 and 16 bits. Written: display-encoded 8-bit RGB.",
                   .recognises = is_sgi,
                   .write_display = write_display_by_plugin}),
    plugin_format({.name = "dds",
                   .label = "DDS",
                   .extensions = {".dds"},
                   .doc = "Read: uncompressed and block-compressed, the largest mip level.",
                   .recognises = is_dds}),
    plugin_format({.name = "cineon",
                   .label = "Cineon",
                   .extensions = {".cin"},
                   .doc = "Read: logarithmic values become linear.",
                   .recognises = is_cineon}),
    plugin_format({.name = "psd",
                   .label = "PSD",
                   .extensions = {".psd", ".psb"},
                   .doc = "Read: the merged image.",
                   .recognises = is_psd}),
    plugin_format(
        {.name = "gif", .label = "GIF", .extensions = {".gif"}, .doc = "Read: the first image.", .recognises = is_gif}),
    plugin_format(
        {.name = "raw",
         .label = "camera raw",
         .extensions = {".dng", ".nef", ".cr2", ".cr3", ".arw", ".raf", ".orf", ".rw2", ".pef", ".srw", ".3fr", ".raw"},
         .doc = "Read: developed to sRGB. Most of these files are TIFF files by their content, so the "
                "extension selects the reader.",
         .recognises = is_raw}),
    plugin_format({.name = "targa",
                   .label = "TGA",
                   .extensions = {".tga"},
                   .doc = "Read: with and without palette, with alpha. Written: display-encoded 8-bit RGB.",
                   .recognises = is_tga,
                   .write_display = write_display_by_plugin}),
};

}  // namespace etendue::image
