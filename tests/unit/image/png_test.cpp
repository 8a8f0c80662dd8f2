// Reading and writing PNG: exact round trips, all colour types, damaged files.
#include <gtest/gtest.h>

#include "base/file.h"
#include "image/image.h"
#include "unit/image/file_bytes.h"

namespace etendue::test {
namespace {

using image::decode_image;
using image::Image;

std::vector<uint8_t> bytes(std::initializer_list<int> values) {
  return std::vector<uint8_t>(values.begin(), values.end());
}

// Bytes as characters, for the rows of a file.
FileBytes raw(std::initializer_list<int> values) {
  FileBytes out;
  for (const int v : values) out.push_back(static_cast<char>(v));
  return out;
}

TEST(Png, RoundTripIsExact) {
  const TemporaryFile file("a.png");
  std::vector<uint8_t> rgb(7 * 5 * 3);
  for (size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<uint8_t>(i * 37);
  ASSERT_TRUE(image::write_png(file.path(), 7, 5, rgb));
  const auto stored = read_file(file.path());
  ASSERT_TRUE(stored);
  const auto image = decode_image(*stored, "a.png");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width, 7);
  EXPECT_EQ(image->height, 5);
  EXPECT_EQ(image->channels, 3);
  EXPECT_EQ(image->bytes, rgb);
}

TEST(Png, StoresTextChunks) {
  const TemporaryFile file("a.png");
  const std::vector<uint8_t> rgb(3);
  ASSERT_TRUE(image::write_png(file.path(), 1, 1, rgb, {{"etendue", "{\"a\":1}"}, {"title", "\xc3\x89tendue"}}));
  const auto stored = read_file(file.path());
  ASSERT_TRUE(stored);
  const std::string text(reinterpret_cast<const char*>(stored->data()), stored->size());
  EXPECT_NE(text.find(std::string("etendue\0", 8)), std::string::npos);
  EXPECT_NE(text.find(std::string("iTXttitle\0", 10)), std::string::npos) << "UTF-8 needs an iTXt chunk";
}

TEST(Png, RejectsInvalidImages) {
  const TemporaryFile file("a.png");
  const std::vector<uint8_t> rgb(3);
  EXPECT_FALSE(image::write_png(file.path(), 2, 1, rgb));
  EXPECT_FALSE(image::write_png(file.path(), 0, 0, {}));
  EXPECT_FALSE(image::write_png(file.path(), 1, 1, rgb, {{"", "no keyword"}}));
  EXPECT_FALSE(image::write_png(file.folder() / "missing" / "a.png", 1, 1, rgb));
  EXPECT_FALSE(std::filesystem::exists(file.path()));
}

TEST(Png, DecodesPaletteWithTransparencyAsRgba) {
  const FileBytes extra = png_chunk("PLTE", raw({10, 20, 30, 200, 100, 50})) + png_chunk("tRNS", raw({128}));
  const auto image = decode_image(view(png_file(3, 1, kPalette, {raw({0b01000000})}, extra)), "palette");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->channels, 4);
  EXPECT_EQ(image->bytes, bytes({10, 20, 30, 128, 200, 100, 50, 255, 10, 20, 30, 128}));
}

TEST(Png, ScalesGreyOfLowBitDepth) {
  const auto image = decode_image(view(png_file(4, 2, kGrey, {raw({0b00011011})})), "grey");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->channels, 1);
  EXPECT_EQ(image->bytes, bytes({0, 85, 170, 255}));
}

TEST(Png, KeepsGreyWithAlpha) {
  const auto image = decode_image(view(png_file(2, 8, kGreyAlpha, {raw({1, 2, 3, 4})})), "grey alpha");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->channels, 2);
  EXPECT_EQ(image->bytes, bytes({1, 2, 3, 4}));
}

TEST(Png, RoundsSixteenBitsToEight) {
  // round(v * 255 / 65535)
  const auto image =
      decode_image(view(png_file(1, 16, kTrueColour, {raw({0xff, 0xff, 0x80, 0x00, 0x00, 0x81})})), "deep");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->bytes, bytes({255, 128, 1}));
}

TEST(Png, IgnoresColourSpaceChunks) {
  FileBytes gamma;
  append_big_endian(gamma, 100000);  // linear
  const auto image =
      decode_image(view(png_file(1, 8, kTrueColour, {raw({10, 100, 200})}, png_chunk("gAMA", gamma))), "gamma");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->bytes, bytes({10, 100, 200}));
}

TEST(Png, EveryTruncationIsAnError) {
  const FileBytes whole =
      png_file(2, 8, kTrueColourAlpha, {raw({1, 2, 3, 4, 5, 6, 7, 8}), raw({9, 8, 7, 6, 5, 4, 3, 2})});
  ASSERT_TRUE(decode_image(view(whole), "whole"));
  for (size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(decode_image(view(whole.substr(0, size)), "cut")) << size;
}

TEST(Png, EveryDamagedByteIsAnError) {
  // All bytes are covered by the checksums of the chunks or are part of the signature.
  const FileBytes whole = png_file(2, 8, kGrey, {raw({1, 2}), raw({3, 4})});
  for (size_t at = 0; at < whole.size(); ++at) {
    FileBytes damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_FALSE(decode_image(view(damaged), "damaged")) << at;
  }
}

TEST(Png, RejectsHugeSizes) {
  for (const auto& [width, height] :
       {std::pair{0x7fffffffU, 0x7fffffffU}, {16385U, 16384U}, {16384U, 16384U}, {0U, 5U}}) {
    const auto image = decode_image(
        view(png_header(width, height, 8, kTrueColourAlpha) + png_chunk("IDAT", "") + png_chunk("IEND", "")),
        "huge.png");
    ASSERT_FALSE(image);
    EXPECT_TRUE(image.error().message.starts_with("huge.png: ")) << image.error().message;
  }
}

TEST(Png, EncodingKeepsChannels) {
  for (int channels = 1; channels <= 4; ++channels) {
    Image source;
    source.width = 5;
    source.height = 3;
    source.channels = channels;
    for (int i = 0; i < 15 * channels; ++i) source.bytes.push_back(static_cast<uint8_t>(53 * i + 7));
    const auto png = image::encode_png(source);
    ASSERT_TRUE(png) << png.error().message;
    const auto again = image::decode_image(*png, "image");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->channels, channels);
    EXPECT_EQ(again->bytes, source.bytes);
  }
  EXPECT_FALSE(image::encode_png(Image{}));
}

TEST(Png, EncodesFloatsWithSixteenBits) {
  Image source;
  source.width = 2;
  source.height = 2;
  source.channels = 1;
  source.type = image::PixelType::float32;
  source.floats = {0, 0.5f, 1, 7};
  const auto png = image::encode_png(source);
  ASSERT_TRUE(png) << png.error().message;
  EXPECT_EQ(static_cast<int>((*png)[24]), 16) << "bit depth in the header";
  EXPECT_EQ(image::decode_image(*png, "image")->bytes, (std::vector<uint8_t>{0, 128, 255, 255}));
}

}  // namespace
}  // namespace etendue::test
