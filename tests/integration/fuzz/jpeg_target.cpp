// JPEG.
#include <turbojpeg.h>

#include "integration/fuzz/image_run.h"

namespace etendue::fuzz {
namespace {

void run(Input input) { decode(input, "jpeg"); }

Bytes encoded(int format, int subsampling, int flags) {
  constexpr int kSide = 16;
  std::vector<uint8_t> pixels(size_t{kSide} * kSide * 3);
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<uint8_t>(i * 7 % 251);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  const tjhandle encoder = tjInitCompress();
  const int failed = tjCompress2(encoder, pixels.data(), kSide, 0, kSide, format, &data, &size, subsampling, 75, flags);
  require(failed == 0, "a seed cannot be encoded as JPEG");
  const Bytes bytes = bytes_of({reinterpret_cast<const char*>(data), size});
  tjFree(data);
  tjDestroy(encoder);
  return bytes;
}

std::vector<Bytes> images() {
  return {encoded(TJPF_RGB, TJSAMP_420, 0), encoded(TJPF_RGB, TJSAMP_444, TJFLAG_PROGRESSIVE),
          encoded(TJPF_GRAY, TJSAMP_GRAY, 0)};
}

}  // namespace

const Target kTarget{.run = run, .seeds = images};

}  // namespace etendue::fuzz
