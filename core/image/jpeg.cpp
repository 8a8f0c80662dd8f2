#include <turbojpeg.h>

#include <memory>

#include "image/codecs.h"

namespace etendue::image {

Result<Image> decode_jpeg(Bytes bytes, const std::string& name) {
  const std::unique_ptr<void, int (*)(void*)> decoder(tjInitDecompress(), tjDestroy);
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, sampling = 0, space = 0;
  if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height, &sampling, &space) != 0)
    return bad_picture(name, std::string("JPEG: ") + tjGetErrorStr2(decoder.get()));
  if (!reasonable(width, height)) return bad_picture(name, "JPEG of an absurd size");
  Image image;
  image.width = width, image.height = height, image.channels = 3;
  image.bytes.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * 3);
  // A warning (a truncated or damaged stream) still gives a picture, but not one to trust.
  if (tjDecompress2(decoder.get(), data, bytes.size(), image.bytes.data(), width, 0, height, TJPF_RGB, TJFLAG_ACCURATEDCT) != 0)
    return bad_picture(name, std::string("JPEG: ") + tjGetErrorStr2(decoder.get()));
  return image;
}

}  // namespace etendue::image
