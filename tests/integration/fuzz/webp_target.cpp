// WebP.
#include <webp/encode.h>

#include "integration/fuzz/image_run.h"

namespace etendue::fuzz {
namespace {

constexpr int kSide = 12;

void run(Input input) { decode(input, "webp"); }

Bytes taken(uint8_t* data, size_t size) {
  require(size > 0, "a seed cannot be encoded as WebP");
  const Bytes bytes = bytes_of({reinterpret_cast<const char*>(data), size});
  WebPFree(data);
  return bytes;
}

std::vector<Bytes> images() {
  std::vector<uint8_t> pixels(size_t{kSide} * kSide * 4);
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<uint8_t>(i * 7 % 251);
  uint8_t* data = nullptr;
  const auto encoded = [&](size_t size) { return taken(data, size); };
  return {encoded(WebPEncodeRGB(pixels.data(), kSide, kSide, 3 * kSide, 60, &data)),
          encoded(WebPEncodeRGBA(pixels.data(), kSide, kSide, 4 * kSide, 60, &data)),
          encoded(WebPEncodeLosslessRGB(pixels.data(), kSide, kSide, 3 * kSide, &data)),
          encoded(WebPEncodeLosslessRGBA(pixels.data(), kSide, kSide, 4 * kSide, &data))};
}

}  // namespace

const Target kTarget{.run = run, .seeds = images};

}  // namespace etendue::fuzz
