// JPEG, baseline and progressive, through libjpeg-turbo. Grey images keep one channel, others are decoded to RGB.
#include <turbojpeg.h>

#include <memory>
#include <type_traits>

#include "image/format.h"
#include "image/plugin_io.h"

namespace etendue::image {
namespace {

using Decoder = std::unique_ptr<std::remove_pointer_t<tjhandle>, int (*)(tjhandle)>;

// A Huffman-coded block of 64 samples takes at least one bit, which is at most 512 pixels per byte. The limit is twice
// that; a file with more pixels per byte is truncated.
constexpr uint64_t kMaxPixelsPerByte = 1024;

// Extraneous bytes between segments are common in files from old cameras and lose no pixels. All other warnings of the
// library mean lost pixels.
bool is_harmless(tjhandle decoder) {
  return tjGetErrorCode(decoder) == TJERR_WARNING &&
         std::string_view(tjGetErrorStr2(decoder)).find("extraneous bytes") != std::string_view::npos;
}

bool is_jpeg(Bytes bytes) { return starts_with(bytes, "\xff\xd8\xff"); }

Result<Image> decode_jpeg(Bytes bytes, const std::string& name) {
  const Decoder decoder(tjInitDecompress(), tjDestroy);
  const auto failed = [&] { return input_error(name + ": damaged JPEG: " + tjGetErrorStr2(decoder.get())); };
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height, &subsampling, &colours) != 0 &&
      !is_harmless(decoder.get()))
    return failed();
  if (colours == TJCS_CMYK || colours == TJCS_YCCK)
    return input_error(name + ": CMYK JPEG is not supported; save the image as RGB");
  const uint64_t w = static_cast<uint64_t>(width), h = static_cast<uint64_t>(height);
  if (auto size = check_image_size(w, h, name); !size) return size.error();
  if (auto length = check_file_length(w * h / kMaxPixelsPerByte, bytes, name); !length) return length.error();

  const bool grey = colours == TJCS_GRAY;
  Image image = make_byte_image(width, height, grey ? 1 : 3);
  // The limit on scans rejects small progressive files that would take minutes to decode.
  constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS;
  if (tjDecompress2(decoder.get(), data, bytes.size(), image.bytes.data(), width, 0, height,
                    grey ? TJPF_GRAY : TJPF_RGB, kFlags) != 0 &&
      !is_harmless(decoder.get()))
    return failed();
  return image;
}

uint64_t decoded_jpeg_size(Bytes bytes) {
  const Decoder decoder(tjInitDecompress(), tjDestroy);
  int width = 0, height = 0, subsampling = 0, colours = 0;
  tjDecompressHeader3(decoder.get(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), &width,
                      &height, &subsampling, &colours);
  return static_cast<uint64_t>(width) * static_cast<uint64_t>(height) * (colours == TJCS_GRAY ? 1 : 3);
}

}  // namespace

extern const ImageFormat kJpegFormat{
    .name = "jpeg",
    .label = "JPEG",
    .extensions = {".jpg", ".jpeg"},
    .doc = "Read: baseline and progressive, grey and RGB. Written: display-encoded, through OpenImageIO.",
    .recognises = is_jpeg,
    .decode = decode_jpeg,
    .decoded_size = decoded_jpeg_size,
    .write_display = write_display_by_plugin,
    .writes_by_plugin = true,
};

}  // namespace etendue::image
