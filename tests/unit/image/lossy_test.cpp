// Reading JPEG and WebP files made by the reference encoders.
#include <gtest/gtest.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include <cstdlib>
#include <memory>

#include "image/image.h"
#include "unit/image/file_bytes.h"

namespace etendue::test {
namespace {

using image::decode_image;

constexpr int kWidth = 40, kHeight = 24;

// A smooth image, which lossy compression changes by a few codes only.
std::vector<uint8_t> gradient(int channels) {
  std::vector<uint8_t> pixels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < channels; ++c)
        pixels.push_back(static_cast<uint8_t>(c == 3 ? 10 * y : 40 + 3 * x + 2 * y + 10 * c));
  return pixels;
}

FileBytes jpeg_of(const std::vector<uint8_t>& pixels, int format, int subsampling, int flags = 0) {
  unsigned char* data = nullptr;
  unsigned long size = 0;
  const tjhandle encoder = tjInitCompress();
  const int failed =
      tjCompress2(encoder, pixels.data(), kWidth, 0, kHeight, format, &data, &size, subsampling, 95, flags);
  EXPECT_EQ(failed, 0);
  FileBytes out(reinterpret_cast<const char*>(data), size);
  tjFree(data);
  tjDestroy(encoder);
  return out;
}

FileBytes webp_lossless(const std::vector<uint8_t>& pixels, int channels) {
  uint8_t* data = nullptr;
  const auto encode = channels == 4 ? WebPEncodeLosslessRGBA : WebPEncodeLosslessRGB;
  const size_t size = encode(pixels.data(), kWidth, kHeight, kWidth * channels, &data);
  FileBytes out(reinterpret_cast<const char*>(data), size);
  WebPFree(data);
  return out;
}

int largest_difference(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  if (a.size() != b.size()) return 256;
  int largest = 0;
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

void set_jpeg_size(FileBytes& file, int width, int height) {
  const size_t frame = file.find("\xff\xc0");
  ASSERT_NE(frame, FileBytes::npos);
  file[frame + 5] = static_cast<char>(height >> 8);
  file[frame + 6] = static_cast<char>(height);
  file[frame + 7] = static_cast<char>(width >> 8);
  file[frame + 8] = static_cast<char>(width);
}

TEST(Jpeg, DecodesColour) {
  for (const int flags : {0, TJFLAG_PROGRESSIVE}) {
    const auto image = decode_image(view(jpeg_of(gradient(3), TJPF_RGB, TJSAMP_444, flags)), "a.jpg");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, kWidth);
    EXPECT_EQ(image->height, kHeight);
    EXPECT_EQ(image->channels, 3);
    EXPECT_LE(largest_difference(image->bytes, gradient(3)), 4);
  }
}

TEST(Jpeg, DecodesGreyAsOneChannel) {
  const auto image = decode_image(view(jpeg_of(gradient(1), TJPF_GRAY, TJSAMP_GRAY)), "a.jpg");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->channels, 1);
  EXPECT_LE(largest_difference(image->bytes, gradient(1)), 4);
}

TEST(Jpeg, EveryTruncationIsAnError) {
  // Without the last two bytes, which are the end marker, all pixels are present.
  for (const int flags : {0, TJFLAG_PROGRESSIVE}) {
    const FileBytes whole = jpeg_of(gradient(3), TJPF_RGB, TJSAMP_420, flags);
    for (size_t size = 0; size + 2 < whole.size(); ++size)
      EXPECT_FALSE(decode_image(view(whole.substr(0, size)), "cut")) << size;
  }
}

TEST(Jpeg, RejectsHugeSizes) {
  FileBytes file = jpeg_of(gradient(3), TJPF_RGB, TJSAMP_444);
  set_jpeg_size(file, 65535, 65535);
  EXPECT_FALSE(decode_image(view(file), "huge"));
  set_jpeg_size(file, 16384, 16384);
  EXPECT_FALSE(decode_image(view(file), "large and empty"));
}

TEST(Jpeg, CmykErrorNamesTheExpectedFormat) {
  const auto image = decode_image(view(jpeg_of(gradient(4), TJPF_CMYK, TJSAMP_444)), "a.jpg");
  ASSERT_FALSE(image);
  EXPECT_NE(image.error().message.find("RGB"), std::string::npos);
}

TEST(Jpeg, DamagedBytesDoNotCrash) {
  const FileBytes whole = jpeg_of(gradient(3), TJPF_RGB, TJSAMP_420);
  for (size_t at = 2; at < whole.size(); ++at) {
    FileBytes damaged = whole;
    damaged[at] = static_cast<char>(~damaged[at]);
    if (const auto image = decode_image(view(damaged), "damaged")) {
      EXPECT_LE(image->bytes.size(), size_t{1} << 24) << at;
    }
  }
}

TEST(WebP, LosslessIsExact) {
  for (const int channels : {3, 4}) {
    const auto image = decode_image(view(webp_lossless(gradient(3 + (channels == 4)), channels)), "a.webp");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->channels, channels);
    // Colours of transparent pixels are not preserved; these are the first row of the gradient.
    const size_t first = channels == 4 ? static_cast<size_t>(kWidth) * 4 : 0;
    const auto expected = gradient(channels);
    EXPECT_TRUE(std::equal(image->bytes.begin() + static_cast<std::ptrdiff_t>(first), image->bytes.end(),
                           expected.begin() + static_cast<std::ptrdiff_t>(first)));
  }
}

TEST(WebP, LossyIsWithinTolerance) {
  uint8_t* data = nullptr;
  const auto pixels = gradient(3);
  const size_t size = WebPEncodeRGB(pixels.data(), kWidth, kHeight, kWidth * 3, 95, &data);
  const FileBytes file(reinterpret_cast<const char*>(data), size);
  WebPFree(data);
  const auto image = decode_image(view(file), "a.webp");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_LE(largest_difference(image->bytes, pixels), 12);
}

TEST(WebP, EveryTruncationIsAnError) {
  const FileBytes whole = webp_lossless(gradient(3), 3);
  ASSERT_TRUE(decode_image(view(whole), "whole"));
  for (size_t size = 0; size + 1 < whole.size(); ++size)
    EXPECT_FALSE(decode_image(view(whole.substr(0, size)), "cut")) << size;
}

TEST(WebP, DamagedBytesDoNotCrash) {
  const FileBytes whole = webp_lossless(gradient(3), 3);
  for (size_t at = 12; at < whole.size(); ++at) {
    FileBytes damaged = whole;
    damaged[at] = static_cast<char>(~damaged[at]);
    (void)static_cast<bool>(decode_image(view(damaged), "damaged"));
  }
}

TEST(Decode, ErrorsOfUnknownFormatsNameTheFile) {
  for (const char* content : {"", "GIF89a", "\x89PN", "RIFF    WAVE", "\x76\x2f\x31\x01"}) {
    const auto image = decode_image(view(content), "thing");
    ASSERT_FALSE(image);
    EXPECT_TRUE(image.error().message.starts_with("thing: "));
  }
}

}  // namespace
}  // namespace etendue::test
