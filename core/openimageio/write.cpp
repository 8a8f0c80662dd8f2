#include "write.h"

#include <OpenImageIO/imageio.h>

#include <exception>
#include <span>
#include <vector>

#include "message.h"

namespace etendue::openimageio {

namespace {

// The pixels and space behind them: the writer of HEIF of OpenImageIO 2.4 reads rows of at least 64 pixels, also the
// last one, which can be shorter.
std::vector<uint8_t> padded(std::span<const uint8_t> pixels) {
  constexpr size_t kRow = 64 * 3;
  std::vector<uint8_t> result(pixels.begin(), pixels.end());
  result.resize(pixels.size() + kRow);
  return result;
}

}  // namespace

Result<void> write_image(const image::PluginWrite& request) try {
  const auto failed = [&](const std::string& message) {
    return output_error(request.name + ": cannot be written: " + cleaned(message, request.path));
  };
  const auto output = OIIO::ImageOutput::create(request.path);
  if (!output) return failed(OIIO::geterror());
  const bool linear = !request.linear.empty();
  const OIIO::TypeDesc type = linear ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
  OIIO::ImageSpec spec(request.width, request.height, 3, type);
  spec.attribute("oiio:ColorSpace", linear ? "linear" : "sRGB");
  spec.attribute("Software", "etendue");
  // 0 to 100, for lossy formats; lossless ones ignore it.
  spec.attribute("CompressionQuality", 95);
  const std::vector<uint8_t> display = padded(request.display);
  const void* pixels = linear ? static_cast<const void*>(request.linear.data()) : display.data();
  if (!output->open(request.path, spec) || !output->write_image(type, pixels) || !output->close())
    return failed(output->geterror());
  // The writer of JPEG 2000 returns success if it fails; that of TIFF leaves a message if it succeeds.
  if (std::string_view(output->format_name()) == "jpeg2000" && output->has_error()) return failed(output->geterror());
  return {};
} catch (const std::exception& error) {
  return output_error(request.name + ": cannot be written: " + cleaned(error.what(), request.path));
}

}  // namespace etendue::openimageio
