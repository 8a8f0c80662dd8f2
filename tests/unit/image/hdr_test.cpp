// Reading and writing Radiance HDR: precision, run-length encodings, damaged files.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/file.h"
#include "image/image.h"
#include "unit/image/file_bytes.h"

namespace etendue::test {
namespace {

using image::decode_image;

FileBytes header(const std::string& resolution) {
  return "#?RADIANCE\n# test file\nFORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n";
}

FileBytes raw(std::initializer_list<int> values) {
  FileBytes out;
  for (const int v : values) out.push_back(static_cast<char>(v));
  return out;
}

Result<image::Image> round_trip(int width, int height, const std::vector<float>& rgb) {
  const TemporaryFile file("a.hdr");
  if (auto written = image::write_hdr(file.path(), width, height, rgb); !written) return written.error();
  const auto stored = read_file(file.path());
  if (!stored) return stored.error();
  return decode_image(*stored, "a.hdr");
}

TEST(Hdr, RoundTripIsWithinHalfAStep) {
  // Widths below 8 are stored flat. Runs are longer than the longest run code.
  for (const int width : {1, 7, 8, 300, 40000}) {
    std::vector<float> rgb;
    for (int i = 0; i < width * 2; ++i) {
      const float noisy = std::exp2(static_cast<float>((i * 7919) % 61) / 2 - 15);
      rgb.insert(rgb.end(), {i % 400 < 200 ? 0.25f : noisy, noisy * 0.3f, i % 5 == 0 ? 0.0f : 1.0f});
    }
    const auto image = round_trip(width, 2, rgb);
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->floats.size(), rgb.size());
    for (size_t i = 0; i < rgb.size(); i += 3) {
      const float largest = std::max(rgb[i], std::max(rgb[i + 1], rgb[i + 2]));
      for (size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(image->floats[i + c], rgb[i + c], largest / 255) << i << " of width " << width;
    }
  }
}

TEST(Hdr, PowersOfTwoAreExact) {
  const std::vector<float> rgb{1, 0.5f, 0.25f, 0, 0, 0, 0x1p-100f, 0, 0x1p-101f, 0x1p100f, 0x1p99f, 0};
  const auto image = round_trip(4, 1, rgb);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->floats, rgb);
}

TEST(Hdr, InvalidValuesBecomeTheNearestValid) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const auto image = round_trip(2, 1, {-1, kNan, 2, kInf, 1, 0});
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->floats[0], 0);
  EXPECT_EQ(image->floats[1], 0);
  EXPECT_EQ(image->floats[2], 2);
  EXPECT_TRUE(std::isfinite(image->floats[3]));
  EXPECT_GT(image->floats[3], 1e38f);
}

TEST(Hdr, ValuesBelowAPowerOfTwoRoundUp) {
  const auto image = round_trip(1, 1, {0.9999f, 0.5f, 0});
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->floats[0], 1.0f);
  EXPECT_EQ(image->floats[1], 0.5f);
}

TEST(Hdr, ReadsFlatPixels) {
  // byte * 2^(exponent - 136): 128 at 129 is one.
  const auto image = decode_image(view(header("-Y 1 +X 2") + raw({128, 64, 0, 129, 255, 1, 0, 136})), "flat");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->floats, (std::vector<float>{1, 0.5f, 0, 255, 1, 0}));
}

TEST(Hdr, ReadsTheOldRunLengthEncoding) {
  // One pixel, repeated 2 + 1 * 256 times, and another one.
  const auto image =
      decode_image(view(header("-Y 1 +X 260") + raw({128, 0, 0, 129, 1, 1, 1, 2, 1, 1, 1, 1, 0, 128, 0, 129})), "old");
  ASSERT_TRUE(image) << image.error().message;
  for (size_t x = 0; x < 259; ++x) ASSERT_EQ(image->floats[3 * x], 1.0f) << x;
  EXPECT_EQ(image->floats[3 * 259], 0.0f);
  EXPECT_EQ(image->floats[3 * 259 + 1], 1.0f);
}

TEST(Hdr, ReadsTheNewRunLengthEncoding) {
  const FileBytes row =
      raw({2, 2, 0, 8}) + raw({136, 128}) + raw({8, 0, 64, 128, 0, 0, 0, 0, 0}) + raw({136, 0}) + raw({136, 129});
  const auto image = decode_image(view(header("-Y 1 +X 8") + row), "new");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->floats[0], 1.0f);
  EXPECT_EQ(image->floats[3 * 1 + 1], 0.5f);
  EXPECT_EQ(image->floats[3 * 2 + 1], 1.0f);
  EXPECT_EQ(image->floats[3 * 7], 1.0f);
}

TEST(Hdr, DamagedRowsAreErrors) {
  EXPECT_FALSE(decode_image(view(header("-Y 1 +X 8") + raw({2, 2, 0, 9}) + FileBytes(40, '\x01')), "another width"));
  EXPECT_FALSE(
      decode_image(view(header("-Y 1 +X 8") + raw({2, 2, 0, 8, 137, 0}) + FileBytes(40, '\x01')), "run too long"));
  EXPECT_FALSE(decode_image(view(header("-Y 1 +X 8") + raw({2, 2, 0, 8, 0, 0}) + FileBytes(40, '\x01')), "empty run"));
  EXPECT_FALSE(decode_image(view(header("-Y 1 +X 4") + raw({1, 1, 1, 2}) + FileBytes(40, '\x05')), "repeats nothing"));
}

TEST(Hdr, EveryTruncationIsAnError) {
  const TemporaryFile file("a.hdr");
  std::vector<float> rgb(20 * 3 * 3);
  for (size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<float>(i % 11);
  ASSERT_TRUE(image::write_hdr(file.path(), 20, 3, rgb));
  const auto stored = read_file(file.path());
  ASSERT_TRUE(stored);
  for (size_t size = 0; size < stored->size(); ++size)
    EXPECT_FALSE(decode_image(std::span(*stored).first(size), "cut")) << size;
}

TEST(Hdr, InvalidHeadersAreErrors) {
  const FileBytes pixels(64, '\x05');
  for (const char* resolution : {"-Y 99999999 +X 99999999", "-Y 16384 +X 16384", "-Y 0 +X 4", "-Y -4 +X 4", "+X 4 -Y 4",
                                 "-Y 4", "", "-Y 18446744073709551617 +X 1"})
    EXPECT_FALSE(decode_image(view(header(resolution) + pixels), "header")) << resolution;
  EXPECT_FALSE(decode_image(view("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + pixels), "XYZ"));
}

TEST(Hdr, ReadsEnvironmentMaps) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  const auto folder = std::filesystem::path(data) / "env";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " does not exist";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".hdr") continue;
    const auto image = image::read_linear(entry.path());
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 2 * image->height) << entry.path() << " must be equirectangular";
    double sum = 0;
    for (const float v : image->layers.front().pixels) sum += v;
    EXPECT_TRUE(std::isfinite(sum) && sum > 0) << entry.path();
  }
}

}  // namespace
}  // namespace etendue::test
