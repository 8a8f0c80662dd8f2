// PNG; the checksums of mutated chunks are corrected.
#include <algorithm>
#include <cstring>

#include "integration/fuzz/image_run.h"
#include "unit/image/file_bytes.h"

namespace etendue::fuzz {
namespace {

void run(Input input) { decode(input, "png"); }

std::vector<Bytes> images() {
  using test::png_chunk;
  using test::png_file;
  return {
      bytes_of(png_file(2, 8, test::kTrueColour, {"abcdef", "ghijkl"})),
      bytes_of(png_file(3, 8, test::kPalette, {{0, 1, 2}}, png_chunk("PLTE", "abcdefghi") + png_chunk("tRNS", "ab"))),
      bytes_of(png_file(2, 16, test::kGreyAlpha, {"abcdefgh"}, png_chunk("tEXt", std::string("key\0text", 8)))),
      bytes_of(png_file(5, 1, test::kGrey, {"a", "b"}, png_chunk("gAMA", std::string("\0\0\x1\0", 4)))),
      bytes_of(png_file(1, 8, test::kTrueColourAlpha, {"abcd"}))};
}

void correct_checksums(Bytes& input) {
  constexpr size_t kSignature = 8, kOverhead = 12;
  const auto length_at = [&](size_t place) {
    size_t length = 0;
    for (size_t k = 0; k < 4; ++k) length = length << 8 | std::to_integer<size_t>(input[place + k]);
    return length;
  };
  for (size_t at = kSignature; at + kOverhead <= input.size();) {
    const size_t length = length_at(at);
    if (length > input.size() - at - kOverhead) return;
    test::FileBytes checksum;
    test::append_big_endian(checksum, test::crc32(std::string(text_of(Input(input).subspan(at + 4, length + 4)))));
    std::memcpy(&input[at + 8 + length], checksum.data(), checksum.size());
    at += kOverhead + length;
  }
}

}  // namespace

const Target kTarget{.run = run, .seeds = images, .repair = correct_checksums};

}  // namespace etendue::fuzz
